(** * Why the clauses hold

    Let eight points realize T, over an ordered field K. The literals of Formula.v then are true or
    false, and every clause of the first four families is true ([axioms_sound], [oriented_sound],
    [no_overlaps_sound]). So a refutation of the formula shows that no points realize T.

    The formula fixes the sign of one tetrahedron. If it is the other one, all determinants are
    taken with the opposite sign: this is the global sign [g] below (true: as they are). *)

From Coq Require Import List Bool ZArith Ring FMapPositive.
From Certify Require Import Definitions Barycentric Integral Lrat Formula.
Import ListNotations.

Section Signs.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Variable p : vertex -> point K.
Variable g : bool.

(** ** What literals and clauses mean *)

Definition signed (s : bool) (x : K) : K := if s then x else - x.
Definition D (q : tetrahedron) : K := signed g (volume p q).
Definition has (q : tetrahedron) (s : bool) : Prop := 0 < signed s (D q).
Definition holds (l : literal) : Prop :=
  match l with Is q s => has q s | Not q s => ~ has q s end.
Definition fails (l : literal) : Prop :=
  match l with Is q s => ~ has q s | Not q s => has q s end.
Definition true_clause (c : list literal) : Prop := exists l, In l c /\ holds l.

Lemma signed_signed s t x : signed s (signed t x) = signed (eqb s t) x.
Proof. destruct s, t; simpl; ring. Qed.
Lemma signed_negb s x : signed (negb s) x = - signed s x.
Proof. destruct s; simpl; ring. Qed.
Lemma has_decidable q s : has q s \/ ~ has q s.
Proof. apply pos_decidable. Qed.
Lemma holds_or_fails l : holds l \/ fails l.
Proof. destruct l as [q s | q s]; simpl; destruct (has_decidable q s); auto. Qed.
Lemma true_or_fails c : true_clause c \/ forall l, In l c -> fails l.
Proof.
  induction c as [| l c IH]; [right; intros l [] |].
  destruct (holds_or_fails l) as [h | h]; [left; exists l; simpl; auto |].
  destruct IH as [(m & i & t) | IH]; [left; exists m; simpl; auto |].
  right. intros m [<- | i]; auto.
Qed.
(** A clause is true if it is absurd that all its literals fail. *)
Lemma by_contradiction c : ((forall l, In l c -> fails l) -> False) -> true_clause c.
Proof. intro h. destruct (true_or_fails c); tauto. Qed.

(** ** Sorting, and numbers *)

Lemma sorted_sound q : volume p q = signed (snd (sorted q)) (volume p (fst (sorted q))).
Proof.
  destruct q as [[[a b] c] d]. unfold sorted.
  repeat match goal with |- context [if exchange ?x ?y then _ else _] => destruct (exchange x y) end;
    cbn [fst snd negb signed volume]; coordinates.
Qed.
Definition atom_true (x : atom) : Prop := has (fst x) (snd x).
Lemma atom_of_sound q s : atom_true (atom_of q s) <-> has q s.
Proof.
  unfold atom_of, atom_true, has, D. rewrite (sorted_sound q). destruct (sorted q) as [r e]; simpl.
  rewrite !signed_signed. now destruct s, e, g.
Qed.

(** A variable means what the table says. *)
Definition val (n : positive) : Prop :=
  match P.find n table with Some x => atom_true x | None => False end.
Lemma val_decidable n : val n \/ ~ val n.
Proof. unfold val. destruct P.find as [x |]; auto. apply has_decidable. Qed.
Lemma same_atom_eq x y : same_atom x y = true -> x = y.
Proof.
  destruct x as [t s], y as [t' s']. unfold same_atom; simpl. rewrite andb_true_iff, eqb_true_iff.
  intros [h ->]. apply same_tetrahedron_eq in h. congruence.
Qed.
Lemma variable_sound x n : variable x = Some n -> (val n <-> atom_true x).
Proof.
  unfold variable, val. destruct (P.find (key x) numbers) as [m |]; try discriminate.
  destruct (P.find m table) as [y |] eqn:e; try discriminate.
  destruct (same_atom x y) eqn:f; try discriminate. intros [= <-]. rewrite e.
  apply same_atom_eq in f as <-. tauto.
Qed.
Lemma encode_literal_sound l n : encode_literal l = Some n -> holds l -> literal_true val n.
Proof.
  destruct l as [q s | q s]; simpl; destruct (variable (atom_of q s)) as [m |] eqn:e;
    try discriminate; intros [= <-]; apply variable_sound in e; rewrite atom_of_sound in e;
    simpl; tauto.
Qed.
Lemma encode_sound c : forall d, encode c = Some d -> true_clause c -> clause_true val d.
Proof.
  induction c as [| l c IH]; simpl; intros d e (m & i & t); [destruct i |].
  destruct (encode_literal l) as [n |] eqn:el; try discriminate.
  destruct (encode c) as [d' |]; try discriminate. injection e as <-. apply clause_true_cons.
  destruct i as [<- | i].
  - left. now apply (encode_literal_sound l).
  - right. apply IH; auto. now exists m.
Qed.
Lemma encode_all_sound cs : (forall c, In c cs -> true_clause c) ->
  forall d, In d (encode_all cs) -> clause_true val d.
Proof.
  induction cs as [| c cs IH]; simpl; intros h d i; [tauto |].
  destruct (encode c) as [d' |] eqn:e; [destruct i as [<- | i] |]; auto.
  apply (encode_sound c); auto.
Qed.

(** ** Exclusive *)

Lemma exclusive_sound c : In c exclusive -> true_clause c.
Proof.
  unfold exclusive. rewrite in_map_iff. intros (q & <- & _). apply by_contradiction. intro h.
  pose proof (h _ (or_introl eq_refl)) as h1. pose proof (h _ (or_intror (or_introl eq_refl))) as h2.
  simpl in h1, h2. unfold has in h1, h2; simpl in h1, h2. now apply pos_not_neg in h1.
Qed.

(** ** Grassmann-Pluecker *)

Lemma not_has q s : ~ has q s -> 0 <= signed (negb s) (D q).
Proof. unfold has. rewrite not_pos, signed_negb. auto. Qed.

Definition product (x : term) : K := D (fst x) * D (snd x).
Lemma strict_sound s x f : (forall l, In l (strict s x f) -> fails l) -> 0 < signed s (product x).
Proof.
  destruct x as [x y]. unfold strict, product. intro h.
  pose proof (h _ (or_introl eq_refl)) as h1. pose proof (h _ (or_intror (or_introl eq_refl))) as h2.
  simpl in *. replace (signed s (D x * D y)) with (signed (eqb f s) (D x) * signed f (D y)).
  - now apply lt_mul.
  - destruct f, s; simpl; ring.
Qed.
Lemma weak_sound s x f : (forall l, In l (weak s x f) -> fails l) -> 0 <= signed s (product x).
Proof.
  destruct x as [x y]. unfold weak, product. intro h.
  pose proof (h _ (or_introl eq_refl)) as h1. pose proof (h _ (or_intror (or_introl eq_refl))) as h2.
  simpl in *. apply not_has in h1, h2. rewrite negb_involutive in h1, h2.
  replace (signed s (D x * D y)) with (signed (eqb f s) (D x) * signed f (D y)).
  - now apply nonneg_mul.
  - destruct f, s; simpl; ring.
Qed.
Lemma terms_zero s t a b c d x y z : In (x, y, z) (terms s t a b c d) ->
  product x + product y + product z = 0.
Proof.
  assert (e : product ((s, t, a, b), (s, t, c, d)) + product ((t, s, a, c), (s, t, b, d)) +
    product ((s, t, a, d), (s, t, b, c)) = 0).
  { unfold product, D. cbn [fst snd volume].
    destruct g; cbn [signed]; coordinates. }
  unfold terms. intros [i | [i | [i | []]]]; injection i as <- <- <-; rewrite <- e; ring.
Qed.
Lemma relation_sound s t a b c d cl : In cl (relation s t a b c d) -> true_clause cl.
Proof.
  unfold relation. rewrite in_flat_map. intros (sign & _ & i). apply in_flat_map in i.
  destruct i as ([[x y] z] & e & i). apply terms_zero in e. apply in_flat_map in i.
  destruct i as (f & _ & i). apply in_flat_map in i. destruct i as (f' & _ & i).
  apply in_map_iff in i. destruct i as (f'' & <- & _). apply by_contradiction. intro h.
  assert (hx : 0 < signed sign (product x)).
  { apply (strict_sound sign x f). intros; apply h. rewrite !in_app_iff. auto. }
  assert (hy : 0 <= signed sign (product y)).
  { apply (weak_sound sign y f'). intros; apply h. rewrite !in_app_iff. auto. }
  assert (hz : 0 <= signed sign (product z)).
  { apply (weak_sound sign z f''). intros; apply h. rewrite !in_app_iff. auto. }
  apply (lt_irrefl K 0).
  assert (e' : signed sign (product x) + (signed sign (product y) + signed sign (product z)) = 0).
  { destruct sign; simpl; [| rewrite <- opp_zero]; rewrite <- e; ring. }
  rewrite <- e' at 2. apply pos_nonneg_add; auto. now apply nonneg_add.
Qed.
Lemma grassmann_pluecker_sound c : In c grassmann_pluecker -> true_clause c.
Proof.
  unfold grassmann_pluecker. rewrite in_flat_map. intros (st & _ & i).
  destruct st as [| s [| t [|]]]; try contradiction. apply in_flat_map in i. destruct i as (l & _ & i).
  destruct l as [| a [| b [| c' [| d [|]]]]]; try contradiction. now apply relation_sound in i.
Qed.

Lemma axioms_satisfied : satisfied val axioms_loaded.
Proof.
  unfold axioms_loaded. apply load_sound; [apply empty_satisfied |]. apply encode_all_sound.
  intros c i. apply in_app_iff in i as [i | i]; [now apply exclusive_sound |].
  now apply grassmann_pluecker_sound.
Qed.

(** ** The dependence of five points (Cramer's rule) *)

Definition coefficient (q : quintuple) (v : vertex) : K :=
  match find (fun c => same_vertex v (fst c)) (coefficients q) with Some (_, x) => D x | None => 0 end.

Lemma same_vertex_refl v : same_vertex v v = true.
Proof. now apply same_vertex_iff. Qed.
Lemma coefficient_in q v x : NoDup (members q) -> In (v, x) (coefficients q) -> coefficient q v = D x.
Proof.
  intros nd i. unfold coefficient. replace (find _ (coefficients q)) with (Some (v, x)); auto.
  assert (nd' : NoDup (map fst (coefficients q))) by now destruct q as [[[[? ?] ?] ?] ?].
  symmetry. revert nd' i. generalize (coefficients q). induction l as [| [w y] l IH]; simpl; [tauto |].
  intros n [e | i].
  - injection e as -> ->. now rewrite same_vertex_refl.
  - inversion n as [| ? ? ni nd']; subst. destruct (same_vertex v w) eqn:e; auto. exfalso.
    apply same_vertex_iff in e as ->. apply ni, in_map_iff. now exists (w, x).
Qed.
Lemma coefficient_out q v : ~ In v (members q) -> coefficient q v = 0.
Proof.
  intro o. unfold coefficient. destruct (find _ (coefficients q)) as [[w x] |] eqn:e; auto.
  apply find_some in e as [i e]. apply same_vertex_iff in e. simpl in e. subst. exfalso. apply o.
  destruct q as [[[[a b] c] d] e]. simpl in *. intuition congruence.
Qed.
Lemma coefficient_exists q v : In v (members q) -> exists x, In (v, x) (coefficients q).
Proof.
  destruct q as [[[[a b] c] d] e]. simpl. intros [<- | [<- | [<- | [<- | [<- | []]]]]]; eauto 7.
Qed.
Lemma coefficient_dependence q : NoDup (members q) -> dependence p (coefficient q).
Proof.
  intro nd.
  assert (h : forall f : vertex -> K, sum (fun v => coefficient q v * f v) =
    list_sum K (members q) (fun v => coefficient q v * f v)).
  { intro f. apply sum_support; auto. intros v o. rewrite coefficient_out by auto. ring. }
  assert (e : forall v x, In (v, x) (coefficients q) -> coefficient q v = D x).
  { intros. now apply coefficient_in. }
  pose proof (h (fun _ => 1)) as h1. pose proof (h (fun v => px (p v))) as hx.
  pose proof (h (fun v => py (p v))) as hy. pose proof (h (fun v => pz (p v))) as hz.
  destruct q as [[[[a b] c] d] e']. unfold members in h1, hx, hy, hz. cbn [list_sum] in h1, hx, hy, hz.
  rewrite (e a (b, c, d, e')), (e b (c, a, d, e')), (e c (a, b, d, e')), (e d (b, a, c, e')),
    (e e' (a, b, c, d)) in h1, hx, hy, hz by (simpl; tauto).
  split.
  - replace (sum _) with (sum (fun v => coefficient (a, b, c, d, e') v * 1)).
    + rewrite h1. unfold D; cbn [volume]. destruct g; cbn [signed]; coordinates.
    + apply sum_ext. intro. ring.
  - unfold combination. rewrite hx, hy, hz. unfold D; cbn [volume].
    destruct g; cbn [signed]; unfold origin; f_equal; coordinates.
Qed.

Lemma in_on q f x : In x (on q f) <-> exists v, In (v, x) (coefficients q) /\ In v f.
Proof.
  unfold on. rewrite in_map_iff. split.
  - intros ([v y] & e & i). simpl in e; subst. apply filter_In in i as [i m]. apply mem_iff in m. eauto.
  - intros (v & i & m). exists (v, x). split; auto. apply filter_In. split; auto. now apply mem_iff.
Qed.
Lemma in_off q f v x : In (v, x) (coefficients q) -> ~ In v f -> In x (off q f).
Proof.
  intros i o. unfold off. apply in_map_iff. exists (v, x). split; auto. apply filter_In.
  split; auto. simpl. now rewrite (proj2 (mem_false v f)).
Qed.
(** The clauses of [overlap] hold if the dependence of the quintuple is zero as soon as it is positive
    only on f and negative only on h. *)
Lemma overlap_true q f h cl : NoDup (members q) ->
  ((forall v, 0 < coefficient q v -> In v f) -> (forall v, 0 < - coefficient q v -> In v h) ->
    forall v, coefficient q v = 0) ->
  In cl (overlap q f h) -> true_clause cl.
Proof.
  intros nd no i. apply by_contradiction. intro fail. unfold overlap in i.
  set (escape := map (fun x => Is x true) (off q f) ++ map (fun x => Is x false) (off q h)) in i.
  assert (zero : (forall l, In l escape -> fails l) -> forall v, coefficient q v = 0).
  { intro he.
    assert (sided : forall s f', (forall x, In x (off q f') -> ~ has x s) ->
      forall v, 0 < signed s (coefficient q v) -> In v f').
    { intros s f' hn v pos. destruct (in_dec vertex_eq_dec v f') as [i' | o]; auto. exfalso.
      destruct (in_dec vertex_eq_dec v (members q)) as [m | m].
      - destruct (coefficient_exists q v m) as [x ix]. apply (hn x); [now apply (in_off q f' v) |].
        unfold has. now rewrite <- (coefficient_in q v x).
      - rewrite coefficient_out in pos by auto. apply (lt_irrefl K 0).
        destruct s; simpl in pos; auto. now rewrite opp_zero in pos. }
    apply no.
    - apply (sided true f). intros x ix. apply (he (Is x true)). unfold escape. apply in_app_iff.
      left. now apply (in_map (fun x => Is x true)).
    - apply (sided false h). intros x ix. apply (he (Is x false)). unfold escape. apply in_app_iff.
      right. now apply (in_map (fun x => Is x false)). }
  assert (absurd : forall k s x, In x (on q k) -> cl = Not x s :: escape -> False).
  { intros k s x ix ->. apply in_on in ix as (v & ix & _).
    pose proof (fail _ (or_introl eq_refl)) as pos. simpl in pos. unfold has in pos.
    rewrite <- (coefficient_in q v x), zero in pos; auto.
    - apply (lt_irrefl K 0). destruct s; simpl in pos; auto. now rewrite opp_zero in pos.
    - intros l il. apply fail. now right. }
  apply in_app_iff in i as [i | i]; apply in_map_iff in i as (x & <- & ix); eapply absurd; eauto.
Qed.

(** Quintuples have five different members, as may be computed. *)
Lemma quintuples_distinct q : In q quintuples -> NoDup (members q).
Proof.
  intro i. apply distinct_sound. revert q i. apply forallb_forall. vm_compute. reflexivity.
Qed.
(** ** The clauses that use that the tetrahedra are realized *)

Variable T : list tetrahedron.
Hypothesis realized : realizes T p.

(** A set of vertices within the vertices of a tetrahedron of T. *)
Definition face (f : vertex -> Prop) : Prop :=
  exists t, In t T /\ forall v, f v -> In v (vertices t).

Lemma no_circuit q (f h : vertex -> Prop) : NoDup (members q) -> face f -> face h ->
  (forall v, 0 < coefficient q v -> f v) -> (forall v, 0 < - coefficient q v -> h v) ->
  forall v, coefficient q v = 0.
Proof.
  intros nd (s & is_ & hs) (t & it & ht) hf hh.
  apply (no_overlap K T p s t); auto using coefficient_dependence.
Qed.

Lemma overlap_sound q f h cl : NoDup (members q) ->
  face (fun v => In v f) -> face (fun v => In v h) -> In cl (overlap q f h) -> true_clause cl.
Proof. intros nd hf hh. apply overlap_true; auto. now apply no_circuit. Qed.

Lemma traces_face q f : In f (traces T q) -> face (fun v => In v f).
Proof.
  unfold traces. intro i. apply filter_In in i as [i _]. apply filter_In in i as [_ i].
  apply existsb_exists in i as (t & it & i). exists t. split; auto. intros v iv.
  unfold included in i. rewrite forallb_forall in i. now apply mem_iff, i.
Qed.
Lemma no_overlaps_sound c : In c (no_overlaps T) -> true_clause c.
Proof.
  unfold no_overlaps. rewrite in_flat_map. intros (q & iq & i). apply quintuples_distinct in iq.
  apply in_flat_map in i. destruct i as (f & hf & i). apply in_flat_map in i. destruct i as (h & hh & i).
  destruct (forallb _ _); [| destruct i]. apply traces_face in hf, hh. now apply (overlap_sound q f h).
Qed.

(** ** Coherent orientation

    If (a, b, c, d) is oriented, and a, b, c, e are the vertices of another tetrahedron, then
    (b, a, c, e) is oriented: otherwise the dependence of a, b, c, d, e would be positive at most on
    a, b, c, e and negative at most on a, b, c, d. *)

Lemma is_cell_face q : is_cell T q = true -> face (fun v => In v (vertices q)).
Proof.
  unfold is_cell. rewrite existsb_exists. intros (t & it & h). exists t. split; auto.
  intros v i. rewrite forallb_forall in h. now apply mem_iff, h.
Qed.
Lemma neighbour a b c d e : NoDup [a; b; c; d] -> ~ In e [a; b; c; d] ->
  face (fun v => In v [a; b; c; d]) -> face (fun v => In v [a; b; c; e]) ->
  has (a, b, c, d) true -> has (b, a, c, e) true.
Proof.
  intros nd ne f1 f2 h. set (q := (a, b, c, d, e)).
  assert (ndq : NoDup (members q)).
  { apply (Permutation.Permutation_NoDup (l := e :: [a; b; c; d])); [| now constructor].
    change (Permutation.Permutation (e :: [a; b; c; d]) ([a; b; c; d] ++ [e])).
    apply Permutation.Permutation_cons_append. }
  assert (ed : coefficient q d = D (b, a, c, e)) by (apply coefficient_in; simpl; tauto).
  assert (ee : coefficient q e = D (a, b, c, d)) by (apply coefficient_in; simpl; tauto).
  unfold has in *; simpl in *. destruct (pos_decidable K (D (b, a, c, e))) as [| n]; auto. exfalso.
  apply (pos_neq_zero K _ h). rewrite <- ee.
  apply (no_circuit q (fun v => In v [a; b; c; e]) (fun v => In v [a; b; c; d])); auto; intros v hv;
    (destruct (in_dec vertex_eq_dec v (members q)) as [i | o];
      [| exfalso; rewrite coefficient_out, ?opp_zero in hv by auto; now apply lt_irrefl in hv]);
    simpl in *.
  - destruct (vertex_eq_dec v d) as [-> |]; [rewrite ed in hv; contradiction |]. intuition congruence.
  - destruct (vertex_eq_dec v e) as [-> |]; [| intuition congruence].
    rewrite ee in hv. now apply pos_not_neg in h.
Qed.

(** Oriented tetrahedra of T. *)
Definition good (q : tetrahedron) : Prop := face (fun v => In v (vertices q)) /\ has q true.
Lemma good_distinct q : good q -> NoDup (vertices q).
Proof.
  intros [_ h]. apply (volume_nodup K p q). intro e. unfold has, D in h. rewrite e in h.
  apply (lt_irrefl K 0). destruct g; simpl in h; auto. now rewrite opp_zero in h.
Qed.
Lemma face_ext (f h : vertex -> Prop) : (forall v, h v -> f v) -> face f -> face h.
Proof. intros i (t & it & ht). exists t. auto. Qed.
Lemma reorder (a b c d : vertex) : NoDup [a; b; c; d] ->
  NoDup [b; d; c; a] /\ NoDup [a; c; d; b] /\ NoDup [a; d; b; c].
Proof.
  intro nd. repeat match goal with h : NoDup (_ :: _) |- _ => inversion_clear h end. simpl in *.
  repeat split; do 4 (apply NoDup_cons; [simpl; intuition congruence |]); apply NoDup_nil.
Qed.
Ltac keep_face h := refine (face_ext _ _ _ h); simpl; clear; intros; tauto.
Lemma opposite_sound q r : opposite q r = true -> is_cell T q = true -> good r -> good q.
Proof.
  destruct q as [[[x y] z] e], r as [[[a b] c] d]. unfold opposite. intros h cell hr.
  pose proof (good_distinct _ hr) as nd. destruct hr as [f1 hr]. apply is_cell_face in cell.
  split; auto. apply andb_true_iff in h as [ne h]. apply existsb_exists in h as (v & iv & h).
  assert (ne' : ~ In e [a; b; c; d]).
  { now apply mem_false, negb_true_iff. }
  assert (main : forall a' b' c' d', D (a', b', c', d') = D (a, b, c, d) ->
    (forall u, In u [a'; b'; c'; d'] <-> In u [a; b; c; d]) -> NoDup [a'; b'; c'; d'] ->
    face (fun u => In u [a'; b'; c'; e]) -> has (b', a', c', e) true).
  { intros a' b' c' d' eD same nd' f2. apply (neighbour a' b' c' d' e); auto.
    - now rewrite same.
    - apply (face_ext (fun u => In u [a; b; c; d])); auto. intros u. apply same.
    - unfold has in *. now rewrite eD. }
  assert (eD : D (b, d, c, a) = D (a, b, c, d) /\ D (a, c, d, b) = D (a, b, c, d) /\
    D (a, d, b, c) = D (a, b, c, d)).
  { unfold D, volume. destruct g; cbn [signed]; repeat split; coordinates. }
  destruct eD as (e1 & e2 & e3).
  unfold beyond in h. simpl in cell, iv.
  assert (at_ : forall u w, same_vertex u w = true -> u = w) by (intros; now apply same_vertex_iff).
  destruct (same_vertex v a); [| destruct (same_vertex v b); [| destruct (same_vertex v c)]];
    rewrite !andb_true_iff in h; destruct h as [[h1 h2] h3]; apply at_ in h1, h2, h3; subst x y z.
  - apply (main b d c a e1); [simpl; tauto | apply (reorder _ _ _ _ nd) | keep_face cell].
  - apply (main a c d b e2); [simpl; tauto | apply (reorder _ _ _ _ nd) | keep_face cell].
  - apply (main a d b c e3); [simpl; tauto | apply (reorder _ _ _ _ nd) | keep_face cell].
  - apply (main a b c d eq_refl); [simpl; tauto | exact nd | keep_face cell].
Qed.
Lemma coherent_sound order : forall known, (forall q, In q known -> good q) ->
  forall q, In q (coherent T known order) -> good q.
Proof.
  induction order as [| r order IH]; simpl; [tauto |]. intros known hk q.
  destruct (is_cell T r && existsb (opposite r) known) eqn:e; [| now apply IH].
  apply andb_true_iff in e as [cell e]. apply existsb_exists in e as (s & is_ & e).
  assert (hr : good r) by (apply (opposite_sound r s); auto).
  intros [<- | i]; auto. apply (IH (r :: known)); auto. intros s' [<- | i']; auto.
Qed.
Definition first (U : list tetrahedron) : option tetrahedron := hd_error (orientation U).
Lemma oriented_sound : (forall q, first T = Some q -> has q true) ->
  forall c, In c (oriented T) -> true_clause c.
Proof.
  unfold first, oriented, orientation. intros h c i. apply in_map_iff in i as (q & <- & i).
  exists (Is q true). split; [now left |]. simpl. revert i.
  destruct (visit 100 T (rev (boundary T))) as [| r order]; [intros [] |].
  destruct (existsb _ T && is_cell T r) eqn:cell; [| intros []]. simpl in h.
  apply andb_true_iff in cell as [_ cell].
  assert (hr : good r) by (split; [now apply is_cell_face | now apply h]).
  intros [<- | i]; [apply hr |].
  apply (coherent_sound order [r]) in i; [apply i |]. intros s [<- | []]; auto.
Qed.

(** ** A refutation *)

Theorem refuted_with_sound extra proof : (forall q, first T = Some q -> has q true) ->
  (forall c, In c extra -> true_clause c) ->
  refuted_with extra axioms_loaded T proof = true -> False.
Proof.
  intros hf he h. unfold refuted_with in h.
  eapply (replay_sound val val_decidable); [| exact h].
  apply load_sound; [apply axioms_satisfied |]. apply encode_all_sound. intros c i.
  rewrite !in_app_iff in i. destruct i as [i | [i | i]]; auto.
  - now apply oriented_sound.
  - now apply no_overlaps_sound.
Qed.
End Signs.
Arguments signed {K}.
Arguments D {K}.
Arguments has {K}.
Arguments holds {K}.
Arguments fails {K}.
Arguments true_clause {K}.

(** The first tetrahedron has one sign or the other; this determines the global sign. *)

Section First.
Variable K : ordered_field.
Add Ring K_ring : (K_ring K).
Variable p : vertex -> point K.

Lemma first_in T q : first T = Some q -> In (fst (sorted q)) T.
Proof.
  unfold first, orientation. destruct (visit 100 T (rev (boundary T))) as [| r order]; [discriminate |].
  destruct (existsb (same_tetrahedron (fst (sorted r))) T && is_cell T r) eqn:c; [| discriminate].
  intros [= <-]. apply andb_true_iff in c as [c _]. apply existsb_exists in c as (t & i & c).
  now apply same_tetrahedron_eq in c as ->.
Qed.
Lemma sorted_not_degenerate T q : realizes T p -> In (fst (sorted q)) T -> volume p q <> zero.
Proof.
  intros real i z. apply (not_degenerate _ _ real _ i). rewrite (sorted_sound K p q) in z.
  destruct (snd (sorted q)); cbn [signed] in z; auto.
  rewrite <- (opp_opp _ (volume p _)), z. apply opp_zero.
Qed.
Lemma some_sign T : realizes T p -> exists g, forall q, first T = Some q -> has p g q true.
Proof.
  intro real. destruct (first T) as [r |] eqn:e; [| now exists true].
  assert (vol : volume p r <> zero).
  { apply first_in in e. now apply (sorted_not_degenerate T). }
  clear e. unfold has, D. destruct (trichotomy K (volume p r)) as [h | [h | h]]; [| contradiction |].
  - exists true. now intros q [= <-].
  - exists false. now intros q [= <-].
Qed.
End First.
