(** * The formula of all triangulations with a given boundary

    For a boundary B and a list of triangulations, a set of clauses (section 4 of FORMAT.md, in
    that order) that every triangulation with the boundary B satisfies unless it is listed
    ([formula_sound]). So if the clauses can be refuted, the list is complete ([complete]).

    Literals speak of faces and of numbers here; at the end they become numbers as in DIMACS. *)

From Coq Require Import List Bool PeanoNat Permutation ZArith Lia.
From Certify Require Import Barycentric Integral Faces Links Lrat.
Import ListNotations.

(** ** Statements

    [Used f]: the face f is used, that is, one of some tetrahedron. [At_least k v n j]: of the
    first n possible edges off the boundary, or tetrahedra, at v, at least j are used. *)
Inductive kind : Type := Edges | Tetrahedra.
Inductive atom : Type := Used (f : list vertex) | At_least (k : kind) (v : vertex) (n j : nat).
Definition literal : Type := bool * atom.
Definition yes (x : atom) : literal := (true, x).
Definition no (x : atom) : literal := (false, x).

(** The quadruples that are no facet: what can be a tetrahedron. *)
Definition is_facet (q : list vertex) : bool := existsb (fun f => subset q (vertices f)) facets.
Definition inner : list (list vertex) := filter (fun q => negb (is_facet q)) (faces 4).
Arguments inner : simpl never.
Definition around (f : list vertex) : list (list vertex) := filter (subset f) inner.

Section Formula.
Variable B : list triangle.

Definition members (k : kind) (v : vertex) : list (list vertex) :=
  match k with Edges => filter (mem v) (inner_edges B) | Tetrahedra => filter (mem v) inner end.

(** ** Triangles: one tetrahedron at those of the boundary, none or two at the others *)

Definition some (qs : list (list vertex)) : list literal := map (fun q => yes (Used q)) qs.
Definition not_all (qs : list (list vertex)) : list literal := map (fun q => no (Used q)) qs.
(** Each of them implies one of the others. *)
Fixpoint never_alone (before after : list (list vertex)) : list (list literal) :=
  match after with
  | [] => []
  | q :: after' => (no (Used q) :: some (before ++ after')) :: never_alone (before ++ [q]) after'
  end.
Definition triangle_clauses : list (list literal) :=
  flat_map (fun f =>
    let qs := around f in
    if covers B f then some qs :: map not_all (choices 2 qs)
    else never_alone [] qs ++ map not_all (choices 3 qs)) (faces 3).

(** ** Edges: no cycle beside something else in the link

    A cycle is given by its three or four vertices in cyclic order. At an edge of the boundary it
    is forbidden if none of its vertices makes a boundary triangle with the edge; at another edge,
    two disjoint cycles are forbidden. *)
Definition cycles3 (l : list vertex) : list (list vertex) := choices 3 l.
Definition cycles4 (l : list vertex) : list (list vertex) :=
  flat_map (fun c => match c with
    | [x; y; z; w] => [[x; z; y; w]; [x; y; z; w]; [x; y; w; z]]
    | _ => []
    end) (choices 4 l).
Definition sides (cycle : list vertex) : list (vertex * vertex) :=
  match cycle with
  | [x; y; z] => [(x, y); (y, z); (z, x)]
  | [x; y; z; w] => [(x, y); (y, z); (z, w); (w, x)]
  | _ => []
  end.
Definition forbidden (e : list vertex) (pairs : list (vertex * vertex)) : list (list literal) :=
  let qs := map (fun p => increasing (fst p :: snd p :: e)) pairs in
  if existsb is_facet qs then [] else [not_all qs].

Definition edge_clauses : list (list literal) :=
  flat_map (fun e =>
    let free := filter (fun v => negb (mem v e) && negb (covers B (v :: e))) all_vertices in
    if covers B e then flat_map (fun c => forbidden e (sides c)) (cycles3 free ++ cycles4 free)
    else
      let first := hd V1 free in
      flat_map (fun c =>
        flat_map (fun d => if mem first c then forbidden e (sides c ++ sides d) else [])
          (cycles3 (filter (fun v => negb (mem v c)) free))) (cycles3 free)) (faces 2).

(** ** Vertices: b - 2 + 2i tetrahedra

    An edge is used if a tetrahedron at it is. *)
Definition used_clauses : list (list literal) :=
  flat_map (fun e => (no (Used e) :: some (around e)) ::
    map (fun q => [yes (Used e); no (Used q)]) (around e)) (inner_edges B).

(** At least j + 1 of the first n + 1 iff: at least j + 1 of the first n, or the last one and at
    least j of the first n. What is true or false anyway is left out; no more than [most] counts. *)
Definition counter (k : kind) (v : vertex) (most : nat) : list (list literal) :=
  let all := members k v in
  flat_map (fun nf =>
    let '(n, f) := nf in
    flat_map (fun j =>
      let defined := At_least k v (S n) (S j) in
      let enough := if j <? Nat.min n most then [At_least k v n (S j)] else [] in
      let one_less := match j with 0 => [] | _ => [At_least k v n j] end in
      map (fun x => [yes defined; no x]) enough ++
      [yes defined :: no (Used f) :: map no one_less] ++
      [no defined :: map yes enough ++ [yes (Used f)]] ++
      map (fun x => no defined :: map yes enough ++ [yes x]) one_less)
      (seq 0 (Nat.min (S n) most))) (combine (seq 0 (length all)) all).

Definition some_of_all (k : kind) (v : vertex) (j : nat) : atom :=
  At_least k v (length (members k v)) j.
Definition vertex_clauses (v : vertex) : list (list literal) :=
  let edges := length (members Edges v) in
  let least := boundary_triangles B v - 2 in
  counter Edges v edges ++ counter Tetrahedra v (least + 2 * edges + 1) ++
  flat_map (fun i =>
    [ (match i with 0 => [] | _ => [no (some_of_all Edges v i)] end) ++
        [yes (some_of_all Tetrahedra v (least + 2 * i))];
      (if i <? edges then [yes (some_of_all Edges v (S i))] else []) ++
        [no (some_of_all Tetrahedra v (least + 2 * i + 1))] ]) (seq 0 (S edges)).

(** ** The whole *)

Definition listed_clause (L : list tetrahedron) : list literal :=
  map (fun q => (negb (used L q), Used q)) inner.
Definition formula (listed : list (list tetrahedron)) : list (list literal) :=
  triangle_clauses ++ edge_clauses ++ used_clauses ++ flat_map vertex_clauses all_vertices ++
  map listed_clause listed.

(** The statements in the order in which they are numbered. *)
Definition counted (k : kind) (v : vertex) (most : nat) : list atom :=
  flat_map (fun n => map (fun j => At_least k v n j) (seq 1 (Nat.min n most)))
    (seq 1 (length (members k v))).
Definition atoms : list atom :=
  map Used inner ++ map Used (inner_edges B) ++
  flat_map (fun v =>
    let edges := length (members Edges v) in
    counted Edges v edges ++ counted Tetrahedra v (boundary_triangles B v - 2 + 2 * edges + 1))
    all_vertices.

(** ** Every clause is true *)

Section Sound.
Hypothesis closed : closed_surface B = true.
Variable T : list tetrahedron.
Hypothesis tri : bounded_by B T.

Definition true_atom (x : atom) : bool :=
  match x with
  | Used f => used T f
  | At_least k v n j => j <=? count (used T) (firstn n (members k v))
  end.
Definition true_literal (l : literal) : bool := eqb (fst l) (true_atom (snd l)).
Definition true_clause (c : list literal) : Prop := existsb true_literal c = true.

Lemma true_in c l : In l c -> true_literal l = true -> true_clause c.
Proof. intros i h. apply existsb_exists. now exists l. Qed.
Lemma true_app c d : true_clause c \/ true_clause d -> true_clause (c ++ d).
Proof. unfold true_clause. now rewrite existsb_app, orb_true_iff. Qed.
Lemma true_cons l c : true_literal l = true \/ true_clause c -> true_clause (l :: c).
Proof. unfold true_clause. simpl. now rewrite orb_true_iff. Qed.

Lemma some_true qs : count (used T) qs <> 0 -> true_clause (some qs).
Proof.
  intro h. apply count_some in h as (q & i & u). apply (true_in _ (yes (Used q))).
  - unfold some. apply in_map_iff. eauto.
  - unfold true_literal. simpl. now rewrite u.
Qed.
Lemma not_all_true qs : (forallb (used T) qs = true -> False) -> true_clause (not_all qs).
Proof.
  induction qs as [| q qs IH]; simpl; intro h; [now destruct h |]. apply true_cons.
  unfold true_literal. simpl. destruct (used T q); simpl in *; auto.
Qed.
Lemma few_true k qs c : count (used T) qs < k -> In c (map not_all (choices k qs)) -> true_clause c.
Proof.
  intros h i. apply in_map_iff in i as (d & <- & i). apply not_all_true. intro e.
  apply (count_choices (used T)) in i; auto. lia.
Qed.
Lemma never_alone_true after : forall before c, count (used T) (before ++ after) <> 1 ->
  In c (never_alone before after) -> true_clause c.
Proof.
  induction after as [| q after IH]; intros before c h; simpl; [tauto |]. intros [<- | i].
  - apply true_cons. unfold true_literal. simpl. destruct (used T q) eqn:e; simpl; auto.
    right. apply some_true. rewrite count_app in *. simpl in h. rewrite e in h. simpl in h. lia.
  - apply (IH (before ++ [q])); auto. now rewrite <- app_assoc.
Qed.

Lemma used_inner q : used T q = true -> In q (faces 4) -> In q inner.
Proof.
  intros u i. apply filter_In. split; auto. apply negb_true_iff, not_true_iff_false. intro h.
  apply existsb_exists in h as (f & j & h). pose proof (face_nodup 4 q (le_n 4) i) as [n l].
  rewrite (used_same T q (vertices f)) in u.
  - now rewrite (facet_not_used B T tri f j) in u.
  - assert (p : Permutation q (vertices f)).
    { apply permutation_subset; auto. now rewrite length_vertices, l. }
    intro v. split; apply Permutation_in; auto using Permutation_sym.
Qed.
Lemma count_inner g : count (used T) (filter g inner) = count (used T) (filter g (faces 4)).
Proof.
  unfold inner. rewrite !count_filter. apply count_ext. intros q i.
  assert (u : used T q = true -> is_facet q = false).
  { intro u. apply used_inner, filter_In in u as [_ u]; auto. now apply negb_true_iff. }
  destruct (used T q); [rewrite u by auto; reflexivity |]. now rewrite !andb_false_r.
Qed.

Lemma triangle_true c : In c triangle_clauses -> true_clause c.
Proof.
  unfold triangle_clauses. rewrite in_flat_map. intros (f & i & h).
  pose proof (degree_cases B T tri f i) as d. unfold degree in d. rewrite <- count_inner in d.
  fold (around f) in d. destruct (covers B f).
  - destruct h as [<- | h]; [apply some_true; lia | apply (few_true 2 (around f)); auto; lia].
  - apply in_app_iff in h as [h | h].
    + apply (never_alone_true (around f) []); auto. simpl. lia.
    + apply (few_true 3 (around f)); auto. lia.
Qed.

(** Cycles consist of different vertices; each has two neighbours. *)
Lemma choices_in A (l : list A) : forall k c, In c (choices k l) ->
  incl c l /\ length c = k /\ (NoDup l -> NoDup c).
Proof.
  induction l as [| x l IH]; intros [| k] c; simpl; try tauto;
    try (intros [<- | []]; repeat split; auto using incl_nil_l; constructor).
  rewrite in_app_iff, in_map_iff. intros [(d & <- & i) | i]; apply IH in i as (s & e & n).
  - repeat split; [| simpl; now rewrite e |].
    + intros y [<- | j]; [now left | right; auto].
    + intro h. inversion h. constructor; auto.
  - repeat split; auto; [now apply incl_tl |]. intro h. inversion h. auto.
Qed.
Definition is_cycle (l c : list vertex) : Prop :=
  incl c l /\ NoDup c /\ (length c = 3 \/ length c = 4).
Lemma cycles3_are l c : NoDup l -> In c (cycles3 l) -> is_cycle l c.
Proof. intros n i. apply choices_in in i as (s & e & k). repeat split; auto. Qed.
Lemma cycles4_are l c : NoDup l -> In c (cycles4 l) -> is_cycle l c.
Proof.
  intros n i. unfold cycles4 in i. apply in_flat_map in i as (d & i & h).
  apply choices_in in i as (s & e & k). specialize (k n).
  destruct d as [| x [| y [| z [| w [|]]]]]; try discriminate.
  assert (p : Permutation [x; y; z; w] c).
  { destruct h as [<- | [<- | [<- | []]]]; auto.
    - apply perm_skip, perm_swap.
    - apply perm_skip, perm_skip, perm_swap. }
  repeat split.
  - intros v j. apply s, (Permutation_in v (Permutation_sym p) j).
  - now apply (Permutation_NoDup p).
  - right. now rewrite <- (Permutation_length p).
Qed.
Lemma two_neighbours l c x : is_cycle l c -> In x c -> exists p q, p <> q /\
  (In (p, x) (sides c) /\ In (x, q) (sides c)).
Proof.
  intros (_ & n & e) i.
  assert (ne : forall A (y z : A) m, NoDup (y :: m) -> In z m -> y <> z)
    by (intros A y z m h j ->; now inversion h).
  destruct c as [| u [| v [| w c]]]; simpl in e; try lia.
  assert (n' : NoDup (v :: w :: c)) by now inversion n.
  assert (n'' : NoDup (w :: c)) by now inversion n'.
  destruct c as [| y [|]]; simpl in e; try lia; simpl in i.
  - destruct i as [<- | [<- | [<- | []]]].
    + exists w, v. split; [intro h; apply (ne _ _ w _ n') | simpl; auto]; simpl; auto.
    + exists u, w. split; [apply (ne _ _ w _ n) | simpl; auto]; simpl; auto.
    + exists v, u. split; [intro h; apply (ne _ _ v _ n) | simpl; auto]; simpl; auto.
  - destruct i as [<- | [<- | [<- | [<- | []]]]].
    + exists y, v. split; [intro h; apply (ne _ _ y _ n') | simpl; tauto]; simpl; auto.
    + exists u, w. split; [apply (ne _ _ w _ n) | simpl; tauto]; simpl; auto.
    + exists v, y. split; [apply (ne _ _ y _ n') | simpl; tauto]; simpl; auto.
    + exists w, u. split; [intro h; apply (ne _ _ w _ n) | simpl; tauto]; simpl; auto.
Qed.
Lemma sides_in c x y : In (x, y) (sides c) -> In x c /\ In y c.
Proof.
  destruct c as [| u [| v [| w [| z [|]]]]]; simpl; try tauto; intro h;
    repeat destruct h as [h | h]; try tauto; injection h as <- <-; tauto.
Qed.
Lemma sides_differ l c x y : is_cycle l c -> In (x, y) (sides c) -> x <> y.
Proof.
  intros (_ & n & _) i.
  destruct c as [| u [| v [| w [| z [|]]]]]; simpl in i; try tauto;
    repeat match goal with H : NoDup (_ :: _) |- _ => apply NoDup_cons_iff in H as [? H] end;
    simpl in *; intuition congruence.
Qed.

Lemma forbidden_true a b l c rest o y x k : a <> b -> is_cycle l c -> ~ In a l -> ~ In b l ->
  In x c -> ~ In o c ->
  (forall u v, In (u, v) rest -> ~ In u [a; b] /\ ~ In v [a; b] /\ u <> v) ->
  ((forall u v, In (u, v) rest -> spans T a b u v) -> spans T a b o y) ->
  In k (forbidden [a; b] (sides c ++ rest)) -> true_clause k.
Proof.
  intros ne cyc na nb ix no good s. unfold forbidden.
  destruct existsb; simpl; [tauto |]. intros [<- | []]. apply not_all_true. intro h.
  rewrite forallb_forall in h.
  assert (sp : forall u v, In (u, v) (sides c ++ rest) -> spans T a b u v).
  { intros u v i. apply (spans_iff B T tri). split.
    - assert (k : ~ In u [a; b] /\ ~ In v [a; b] /\ u <> v).
      { apply in_app_iff in i as [i | i]; auto. pose proof (sides_differ l c u v cyc i).
        destruct cyc as (inc & _). apply sides_in in i as [i i']. apply inc in i, i'.
        simpl. intuition congruence. }
      clear - ne k. simpl in k. repeat constructor; simpl; intuition congruence.
    - rewrite <- (h (increasing [u; v; a; b])).
      + apply used_same. intro w. rewrite in_increasing. simpl. tauto.
      + apply in_map_iff. now exists (u, v). }
  assert (swap : forall u v, spans T a b u v -> spans T a b v u).
  { intros u v. apply spans_permutation, perm_skip, perm_skip, perm_swap. }
  apply (no_closed_part B T tri a b c x o y); auto.
  - intros u i. destruct (two_neighbours l c u cyc i) as (p & q & d & s1 & s2).
    pose proof (sides_in c p u s1) as [ip _]. pose proof (sides_in c u q s2) as [_ iq].
    exists p, q. repeat split; auto; [apply swap |]; apply sp, in_app_iff; auto.
  - apply s. intros u v i. apply sp, in_app_iff. now right.
Qed.

Lemma cycle_head l c : is_cycle l c -> exists x, In x c.
Proof. intros (_ & _ & e). destruct c as [| x]; simpl in e; [lia | exists x; now left]. Qed.

Lemma edge_true k : In k edge_clauses -> true_clause k.
Proof.
  unfold edge_clauses. rewrite in_flat_map. intros (e & i & h).
  pose proof (face_2 e i) as (a & b & -> & ne). revert h. cbv zeta. set (free := filter _ _).
  assert (nf : NoDup free) by apply NoDup_filter, all_vertices_nodup.
  assert (out : forall v, In v free -> ~ In v [a; b] /\ covers B [v; a; b] = false).
  { intros v j. apply filter_In in j as [_ j].
    now rewrite andb_true_iff, !negb_true_iff, mem_false in j. }
  assert (na : ~ In a free) by (intro j; apply out in j; simpl in j; tauto).
  assert (nb : ~ In b free) by (intro j; apply out in j; simpl in j; tauto).
  destruct (covers B [a; b]) eqn:on.
  - (* some o is an end of the link's path *)
    assert (end_ : exists o y, ~ In o free /\ spans T a b o y).
    { pose proof closed as n. apply andb_true_iff in n as [n _]. rewrite forallb_forall in n.
      apply covers_iff in on as (t & it & s). specialize (n t it). apply distinct_iff in n.
      destruct (existsb (fun o => negb (mem o [a; b]) && mem o (corners t)) all_vertices) eqn:ex.
      - apply existsb_exists in ex as (o & _ & k').
        rewrite andb_true_iff, negb_true_iff, mem_false, mem_iff in k'. destruct k' as [no io].
        assert (cov : covers B [o; a; b] = true).
        { apply covers_iff. exists t. split; auto. rewrite subset_iff in *.
          intros v [<- | j]; auto. }
        assert (m : NoDup [a; b; o]).
        { clear - ne no. repeat constructor; simpl in *; intuition congruence. }
        pose proof cov as cov'. rewrite (covers_same B _ [a; b; o]) in cov' by (simpl; tauto).
        apply face_covers, (boundary B T tri) in cov' as (d & _ & ap); auto.
        exists o, d. split; [| apply ap; now left]. intro j. apply out in j as [_ j]. congruence.
      - exfalso. assert (sub : incl (corners t) [a; b]).
        { intros v j. destruct (mem v [a; b]) eqn:mv; [now apply mem_iff |].
          apply not_true_iff_false in ex. destruct ex. apply existsb_exists. exists v.
          split; [apply in_all_vertices |]. apply mem_iff in j. now rewrite mv, j. }
        apply NoDup_incl_length in sub; auto. rewrite length_corners in sub. simpl in sub. lia. }
    destruct end_ as (o & y & no & so). intro h. apply in_flat_map in h as (c & j & h).
    assert (cyc : is_cycle free c).
    { apply in_app_iff in j as [j | j]; [now apply cycles3_are | now apply cycles4_are]. }
    destruct (cycle_head free c cyc) as [x ix].
    rewrite <- (app_nil_r (sides c)) in h.
    apply (forbidden_true a b free c [] o y x k); auto.
    intro j'. apply no. now apply cyc.
  - intro h. apply in_flat_map in h as (c & j & h). apply in_flat_map in h as (d & j' & h).
    destruct (mem (hd V1 free) c); [| destruct h].
    set (rest := filter _ free) in *. assert (nr : NoDup rest) by now apply NoDup_filter.
    pose proof (cycles3_are _ _ nf j) as cyc. pose proof (cycles3_are _ _ nr j') as cyd.
    assert (sub : forall v, In v d -> In v free /\ ~ In v c).
    { intros v iv. destruct cyd as (s & _). apply s in iv. apply filter_In in iv.
      now rewrite negb_true_iff, mem_false in iv. }
    destruct (cycle_head _ c cyc) as [x ix], (cycle_head _ d cyd) as [o io].
    destruct (two_neighbours _ d o cyd io) as (p & y & _ & _ & so).
    apply (forbidden_true a b free c (sides d) o y x k); auto.
    + now apply sub.
    + intros u v iuv. pose proof (sides_differ _ d u v cyd iuv). apply sides_in in iuv as [iu iv].
      apply sub in iu as [iu _], iv as [iv _]. apply out in iu as [iu _], iv as [iv _]. auto.
Qed.

Lemma used_true c : In c used_clauses -> true_clause c.
Proof.
  unfold used_clauses. rewrite in_flat_map. intros (e & _ & [<- | h]).
  - apply true_cons. unfold true_literal. simpl. destruct (used T e) eqn:u; simpl; auto. right.
    apply (used_tetrahedron T (T_nodup B T tri)) in u as (q & i & s & u).
    apply (true_in _ (yes (Used q))); [| unfold true_literal; simpl; now rewrite u].
    apply in_map_iff. exists q. split; auto. apply filter_In. auto using used_inner.
  - apply in_map_iff in h as (q & <- & i). apply filter_In in i as [_ s].
    unfold true_clause, true_literal. simpl. pose proof (used_subset T e q s).
    destruct (used T e), (used T q); simpl; auto.
Qed.

(** Counters. *)
Lemma count_firstn n (l : list (list vertex)) x : nth_error l n = Some x ->
  count (used T) (firstn (S n) l) = count (used T) (firstn n l) + Nat.b2n (used T x).
Proof.
  revert n. induction l as [| y l IH]; intros [| n] h; try discriminate.
  - injection h as ->. simpl. lia.
  - cbn [firstn count nth_error] in *. rewrite <- Nat.add_assoc. f_equal. now apply IH.
Qed.
Lemma count_bound n (l : list (list vertex)) : count (used T) (firstn n l) <= n.
Proof.
  etransitivity; [apply count_le | apply firstn_le_length].
Qed.
Lemma in_combine_seq A (l : list A) : forall s n x, In (n, x) (combine (seq s (length l)) l) ->
  s <= n /\ nth_error l (n - s) = Some x.
Proof.
  induction l as [| y l IH]; simpl; [tauto |]. intros s n x [e | h].
  - injection e as <- <-. split; auto. now rewrite Nat.sub_diag.
  - apply IH in h as [h1 h2]. split; [lia |]. now replace (n - s) with (S (n - S s)) by lia.
Qed.
Lemma counter_true k v most c : In c (counter k v most) -> true_clause c.
Proof.
  unfold counter. cbv zeta. rewrite in_flat_map. intros ([n f] & i & h).
  apply in_combine_seq in i as [_ i]. rewrite Nat.sub_0_r in i.
  apply in_flat_map in h as (j & hj & h). apply in_seq in hj.
  pose proof (count_firstn n _ f i) as next. pose proof (count_bound n (members k v)) as bound.
  set (m := count (used T) (firstn n (members k v))) in *.
  assert (d1 : true_atom (At_least k v (S n) (S j)) = (S j <=? m + Nat.b2n (used T f))).
  { cbn [true_atom]. now rewrite next. }
  assert (d2 : forall j, true_atom (At_least k v n j) = (j <=? m)) by reflexivity.
  assert (d3 : true_atom (Used f) = used T f) by reflexivity.
  clearbody m. clear next i.
  destruct (Nat.ltb_spec j (Nat.min n most)) as [lt | ge];
    destruct j as [| j]; cbn [map app In] in h;
    repeat (destruct h as [h | h]; [subst c; unfold true_clause, true_literal;
      cbn [existsb fst snd yes no app map]; rewrite ?d1, ?d2, ?d3; destruct (used T f);
      cbn [Nat.b2n];
      repeat match goal with |- context [?x <=? ?y] => destruct (Nat.leb_spec x y) end;
      simpl; auto; lia |]); tauto.
Qed.

Lemma vertex_true v c : In c (vertex_clauses v) -> true_clause c.
Proof.
  unfold vertex_clauses. cbv zeta. rewrite !in_app_iff.
  intros [h | [h | h]]; [now apply counter_true in h | now apply counter_true in h |].
  apply in_flat_map in h as (i & hi & h). apply in_seq in hi.
  destruct (tetrahedra_at_vertex B T tri closed v) as [w e].
  unfold at_vertex in e. rewrite <- count_inner in e.
  assert (d : forall k j, true_atom (some_of_all k v j) = (j <=? count (used T) (members k v))).
  { intros k j. unfold some_of_all. cbn [true_atom]. now rewrite firstn_all. }
  change (filter (mem v) inner) with (members Tetrahedra v) in e.
  change (filter (mem v) (inner_edges B)) with (members Edges v) in e.
  assert (bound : count (used T) (members Edges v) <= length (members Edges v)) by apply count_le.
  unfold true_clause, true_literal.
  destruct h as [<- | [<- | []]]; rewrite existsb_app; cbn [existsb fst snd yes no].
  - destruct i as [| i]; cbn [existsb fst snd no]; rewrite ?d;
      repeat match goal with |- context [?x <=? ?y] => destruct (Nat.leb_spec x y) end;
      simpl; auto; lia.
  - destruct (Nat.ltb_spec i (length (members Edges v))); cbn [existsb fst snd yes]; rewrite ?d;
      repeat match goal with |- context [?x <=? ?y] => destruct (Nat.leb_spec x y) end;
      simpl; auto; lia.
Qed.

Lemma listed_true L :
  (forall q, In q inner -> used T q = used L q) \/ true_clause (listed_clause L).
Proof.
  destruct (existsb true_literal (listed_clause L)) eqn:e; [now right | left].
  intros q i. apply not_true_iff_false in e. destruct (eqb (used T q) (used L q)) eqn:k.
  - now apply eqb_prop.
  - exfalso. apply e. apply existsb_exists. exists (negb (used L q), Used q). split.
    + apply in_map_iff. now exists q.
    + unfold true_literal. simpl. destruct (used T q), (used L q); auto; discriminate.
Qed.

Theorem formula_sound listed :
  (exists L, In L listed /\ forall q, In q inner -> used T q = used L q) \/
  forall c, In c (formula listed) -> true_clause c.
Proof.
  assert (l : (exists L, In L listed /\ forall q, In q inner -> used T q = used L q) \/
    forall L, In L listed -> true_clause (listed_clause L)).
  { induction listed as [| L listed IH]; [right; intros L [] |].
    destruct (listed_true L) as [h | h]; [left; exists L; simpl; auto |].
    destruct IH as [(M & i & k) | IH]; [left; exists M; simpl; auto |].
    right. intros M [<- | i]; auto. }
  destruct l as [l | l]; [now left | right]. intros c h. unfold formula in h.
  rewrite !in_app_iff in h. destruct h as [h | [h | [h | [h | h]]]].
  - now apply triangle_true.
  - now apply edge_true.
  - now apply used_true.
  - apply in_flat_map in h as (v & _ & h). now apply (vertex_true v).
  - apply in_map_iff in h as (L & <- & i). auto.
Qed.
End Sound.
End Formula.

(** ** Numbers instead of statements

    The k-th statement of [atoms] has the number k. Two tables are built, from numbers to
    statements and back; since the second is found by a key, whose uniqueness need not be proved,
    every look-up is tested with the first. *)

Fixpoint equal_faces (f g : list vertex) : bool :=
  match f, g with
  | [], [] => true
  | v :: f', w :: g' => same_vertex v w && equal_faces f' g'
  | _, _ => false
  end.
Lemma equal_faces_sound f : forall g, equal_faces f g = true -> f = g.
Proof.
  induction f as [| v f IH]; intros [| w g]; simpl; try discriminate; auto.
  rewrite andb_true_iff, same_vertex_iff. intros [<- h]. f_equal. auto.
Qed.
Definition same_kind (k l : kind) : bool :=
  match k, l with Edges, Edges | Tetrahedra, Tetrahedra => true | _, _ => false end.
Definition same_atom (x y : atom) : bool :=
  match x, y with
  | Used f, Used g => equal_faces f g
  | At_least k v n j, At_least l w m i =>
      same_kind k l && same_vertex v w && (n =? m) && (j =? i)
  | _, _ => false
  end.
Lemma same_atom_sound x y : same_atom x y = true -> x = y.
Proof.
  destruct x as [f | k v n j], y as [g | l w m i]; simpl; try discriminate.
  - intro h. f_equal. now apply equal_faces_sound.
  - rewrite !andb_true_iff, same_vertex_iff, !Nat.eqb_eq. intros [[[h <-] <-] <-].
    destruct k, l; auto; discriminate.
Qed.

Definition vertex_bits (v : vertex) : list bool :=
  match v with
  | V1 => [false; false; false] | V2 => [true; false; false]
  | V3 => [false; true; false] | V4 => [true; true; false]
  | V5 => [false; false; true] | V6 => [true; false; true]
  | V7 => [false; true; true] | V8 => [true; true; true]
  end.
(** Numbers below 64, in six bits. *)
Definition number_bits (n : nat) : list bool :=
  map (fun power => negb (Nat.even (n / power))) [1; 2; 4; 8; 16; 32].
Definition key (x : atom) : positive :=
  match x with
  | Used f => xO (bits (flat_map vertex_bits f))
  | At_least k v n j =>
      xI (bits (same_kind k Edges :: vertex_bits v ++ number_bits n ++ number_bits j))
  end.

Fixpoint by_number (n : positive) (l : list atom) (m : P.t atom) : P.t atom :=
  match l with [] => m | x :: l' => by_number (Pos.succ n) l' (P.add n x m) end.
Fixpoint by_key (n : positive) (l : list atom) (m : P.t positive) : P.t positive :=
  match l with [] => m | x :: l' => by_key (Pos.succ n) l' (P.add (key x) n m) end.

Section Numbered.
Variable table : P.t atom.
Variable index : P.t positive.

Definition number (x : atom) : option positive :=
  match P.find (key x) index with
  | Some n => match P.find n table with
              | Some y => if same_atom x y then Some n else None
              | None => None
              end
  | None => None
  end.
Fixpoint encode (c : list literal) : option clause :=
  match c with
  | [] => Some []
  | (b, x) :: c' =>
      match number x, encode c' with
      | Some n, Some d => Some ((if b then Zpos n else Zneg n) :: d)
      | _, _ => None
      end
  end.
Fixpoint encode_all (cs : list (list literal)) : list clause :=
  match cs with
  | [] => []
  | c :: cs' => match encode c with Some d => d :: encode_all cs' | None => encode_all cs' end
  end.

Variable truth : atom -> bool.
Definition value (n : positive) : Prop :=
  match P.find n table with Some x => truth x = true | None => False end.
Lemma value_decidable n : value n \/ ~ value n.
Proof. unfold value. destruct P.find as [x |]; auto. destruct (truth x); auto. Qed.
Lemma number_sound x n : number x = Some n -> (value n <-> truth x = true).
Proof.
  unfold number. destruct (P.find (key x) index) as [m |]; try discriminate.
  destruct (P.find m table) as [y |] eqn:f; try discriminate.
  destruct (same_atom x y) eqn:s; try discriminate. apply same_atom_sound in s as <-.
  intros [= <-]. unfold value. now rewrite f.
Qed.
Lemma encode_sound c : forall d, encode c = Some d ->
  existsb (fun l : literal => eqb (fst l) (truth (snd l))) c = true -> clause_true value d.
Proof.
  induction c as [| [b x] c IH]; simpl; intros d e h; [discriminate |].
  destruct (number x) as [n |] eqn:ex; try discriminate.
  destruct (encode c) as [d' |]; try discriminate. injection e as <-.
  apply number_sound in ex. apply orb_true_iff in h as [h | h].
  - apply eqb_prop in h. exists (if b then Zpos n else Zneg n). split; [now left |].
    destruct b; simpl; rewrite ex; congruence.
  - destruct (IH d' eq_refl h) as (l & i & t). exists l. split; auto. now right.
Qed.
Lemma encode_all_sound cs :
  (forall c, In c cs -> existsb (fun l : literal => eqb (fst l) (truth (snd l))) c = true) ->
  forall d, In d (encode_all cs) -> clause_true value d.
Proof.
  induction cs as [| c cs IH]; simpl; intros h d i; [tauto |].
  destruct (encode c) as [d' |] eqn:e; [destruct i as [<- | i] |]; auto.
  apply (encode_sound c); auto.
Qed.
End Numbered.

Definition numbered (B : list triangle) (listed : list (list tetrahedron)) : list clause :=
  let l := atoms B in
  encode_all (by_number 1 l (P.empty _)) (by_key 1 l (P.empty _)) (formula B listed).

Theorem complete B listed proof :
  closed_surface B = true -> refutes (numbered B listed) proof = true ->
  forall T, bounded_by B T ->
  exists L, In L listed /\ forall q, In q inner -> used T q = used L q.
Proof.
  intros closed r T tri.
  destruct (formula_sound B closed T tri listed) as [h | h]; [exact h | exfalso].
  unfold numbered in r. cbv zeta in r. revert r. set (table := by_number _ _ _). intro r.
  apply (refutes_sound (value table (true_atom B T)) (value_decidable _ _)) in r; auto.
  now apply encode_all_sound.
Qed.
