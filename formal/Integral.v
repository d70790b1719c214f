(** * Integer points

    The points of the certificates are integers. Every ordered field contains the integers, so they
    are points of K^3 for each K at once. This file has the arithmetic of integer points as Coq
    functions that compute, the map [image] into K^3, and the criterion by which the points are
    shown to realize a pattern:

    two tetrahedra S and T meet properly if there is an affine function that is >= 0 on S, <= 0 on
    T, and > 0 at the vertices of S that T lacks ([separated]).

    Such a function is searched among the sums of planes through three of the vertices; that they
    are sought in this way need not concern whoever believes the result, since it is tested. *)

From Coq Require Import List Bool ZArith Ring InitialRing Lia Permutation.
From Certify Require Import Definitions Barycentric.
Import ListNotations.

(** ** Arithmetic of integer points *)

Definition zpoint : Type := (Z * Z * Z)%type.
Section Integers.
Local Open Scope Z_scope.
Definition zminus (a b : zpoint) : zpoint :=
  let '(xa, ya, za) := a in let '(xb, yb, zb) := b in (xa - xb, ya - yb, za - zb).
Definition zplus (a b : zpoint) : zpoint :=
  let '(xa, ya, za) := a in let '(xb, yb, zb) := b in (xa + xb, ya + yb, za + zb).
Definition zdot (a b : zpoint) : Z :=
  let '(xa, ya, za) := a in let '(xb, yb, zb) := b in xa * xb + ya * yb + za * zb.
Definition zcross (a b : zpoint) : zpoint :=
  let '(xa, ya, za) := a in let '(xb, yb, zb) := b in
  (ya * zb - za * yb, za * xb - xa * zb, xa * yb - ya * xb).
Definition zdet3 (a b c : zpoint) : Z := zdot a (zcross b c).
Definition zdet (a b c d : zpoint) : Z := zdet3 (zminus b a) (zminus c a) (zminus d a).

(** An affine function: q |-> n q + e. *)
Definition affine : Type := (zpoint * Z)%type.
Definition value (f : affine) (q : zpoint) : Z := zdot (fst f) q + snd f.
Definition zero_function : affine := ((0, 0, 0), 0).
Definition plus (f g : affine) : affine := (zplus (fst f) (fst g), snd f + snd g).
Definition negative (f : affine) : affine := (zminus (0, 0, 0) (fst f), - snd f).
Definition plane (a b c : zpoint) : affine :=
  let n := zcross (zminus b a) (zminus c a) in (n, - zdot n a).
End Integers.

(** The placement given by a list of eight points, vertex 1 first. *)
Definition place (l : list zpoint) (v : vertex) : zpoint :=
  match l with
  | [q1; q2; q3; q4; q5; q6; q7; q8] =>
      match v with V1 => q1 | V2 => q2 | V3 => q3 | V4 => q4
                 | V5 => q5 | V6 => q6 | V7 => q7 | V8 => q8 end
  | _ => (0, 0, 0)%Z
  end.

(** ** Membership and choices, as functions that compute *)

Definition same_vertex (v w : vertex) : bool :=
  match v, w with
  | V1, V1 | V2, V2 | V3, V3 | V4, V4 | V5, V5 | V6, V6 | V7, V7 | V8, V8 => true
  | _, _ => false
  end.
Lemma same_vertex_iff v w : same_vertex v w = true <-> v = w.
Proof. destruct v, w; simpl; split; congruence. Qed.
Definition same_tetrahedron (s t : tetrahedron) : bool :=
  let '(a, b, c, d) := s in let '(a', b', c', d') := t in
  same_vertex a a' && same_vertex b b' && same_vertex c c' && same_vertex d d'.
Lemma same_tetrahedron_eq s t : same_tetrahedron s t = true -> s = t.
Proof.
  destruct s as [[[a b] c] d], t as [[[a' b'] c'] d']; simpl.
  rewrite !andb_true_iff, !same_vertex_iff. intuition congruence.
Qed.
Definition mem (v : vertex) (l : list vertex) : bool := existsb (same_vertex v) l.
Lemma mem_iff v l : mem v l = true <-> In v l.
Proof.
  unfold mem. rewrite existsb_exists. split.
  - intros (w & i & e). apply same_vertex_iff in e. now subst.
  - intro i. exists v. split; auto. now apply same_vertex_iff.
Qed.
Lemma mem_false v l : mem v l = false <-> ~ In v l.
Proof. rewrite <- mem_iff. destruct (mem v l); split; congruence. Qed.

Definition contains (t : tetrahedron) (l : list vertex) : bool :=
  forallb (fun v => mem v (vertices t)) l.
Lemma contains_iff t l : contains t l = true <-> incl l (vertices t).
Proof.
  unfold contains. rewrite forallb_forall. split; intros h v i; [apply mem_iff | apply mem_iff]; auto.
Qed.
Fixpoint distinct (l : list vertex) : bool :=
  match l with [] => true | v :: l' => negb (mem v l') && distinct l' end.
Lemma distinct_sound l : distinct l = true -> NoDup l.
Proof.
  induction l as [| v l IH]; simpl; constructor; apply andb_true_iff in H as [h1 h2]; auto.
  apply mem_false. now destruct (mem v l).
Qed.

(** All ways to choose k members of a list, in lexicographic order. *)
Fixpoint choices {A} (k : nat) (l : list A) : list (list A) :=
  match k, l with
  | 0, _ => [[]]
  | S k', x :: l' => map (cons x) (choices k' l') ++ choices k l'
  | S _, [] => []
  end.

(** A test of every unordered pair of different places of a list. *)
Fixpoint all_pairs {A} (f : A -> A -> bool) (l : list A) : bool :=
  match l with [] => true | x :: l' => forallb (f x) l' && all_pairs f l' end.
Lemma all_pairs_sound A (f : A -> A -> bool) l : all_pairs f l = true ->
  forall x y, In x l -> In y l -> x = y \/ f x y = true \/ f y x = true.
Proof.
  induction l as [| z l IH]; simpl; [tauto |]. rewrite andb_true_iff, forallb_forall.
  intros [h1 h2] x y [<- | hx] [<- | hy]; auto.
Qed.

(** Two lists of the same length whose members pass a test, one by one. *)
Fixpoint all_two {A B} (f : A -> B -> bool) (l : list A) (m : list B) : bool :=
  match l, m with
  | [], [] => true
  | x :: l', y :: m' => f x y && all_two f l' m'
  | _, _ => false
  end.
Lemma all_two_sound A B (f : A -> B -> bool) l : forall m, all_two f l m = true ->
  forall x, In x l -> exists y, f x y = true.
Proof.
  induction l as [| z l IH]; intros [| y m]; simpl; try tauto; try discriminate.
  rewrite andb_true_iff. intros [h1 h2] x [<- | i]; eauto.
Qed.

(** ** Tests of a placement *)

Section Tests.
Variable p : vertex -> zpoint.
Local Open Scope Z_scope.

Definition zvolume (t : tetrahedron) : Z :=
  let '(a, b, c, d) := t in zdet (p a) (p b) (p c) (p d).

Definition weakly_separates (f : affine) (s t : list vertex) : bool :=
  forallb (fun v => 0 <=? value f (p v)) s && forallb (fun v => value f (p v) <=? 0) t.
Definition separates (f : affine) (s t : list vertex) : bool :=
  weakly_separates f s t && forallb (fun v => mem v t || (0 <? value f (p v))) s.

(** Add up planes that separate weakly until the sum separates. *)
Fixpoint search (planes : list (list vertex)) (s t : list vertex) (f : affine) : bool :=
  match planes with
  | [a; b; c] :: planes' =>
      let g := plane (p a) (p b) (p c) in
      let h := negative g in
      if weakly_separates g s t
      then let f := plus f g in separates f s t || search planes' s t f
      else if weakly_separates h s t
      then let f := plus f h in separates f s t || search planes' s t f
      else search planes' s t f
  | _ => false
  end.
Definition separable (s t : tetrahedron) : bool :=
  let s := vertices s in let t := vertices t in
  let common := filter (fun v => mem v t) s in
  let others := filter (fun v => (mem v s || mem v t) && negb (mem v common)) all_vertices in
  search (map (fun l => common ++ l) (choices (3 - length common) others)) s t zero_function.

Definition realizes_test (T : list tetrahedron) : bool :=
  forallb (fun t => negb (zvolume t =? 0)) T && all_pairs separable T.

(** A vertex is extreme if a sum of planes through it is positive at all other points. *)
Definition supports (f : affine) : bool := forallb (fun u => 0 <=? value f (p u)) all_vertices.
Definition support (v : vertex) : affine :=
  fold_left (fun f l =>
    match l with
    | [a; b] => let g := plane (p v) (p a) (p b) in
        if supports g then plus f g else if supports (negative g) then plus f (negative g) else f
    | _ => f
    end) (choices 2 (filter (fun u => negb (same_vertex u v)) all_vertices)) zero_function.
Definition extreme_test (v : vertex) : bool :=
  let f := support v in
  (value f (p v) =? 0) &&
  forallb (fun u => same_vertex u v || (0 <? value f (p u))) all_vertices.
Definition convex_test : bool := forallb extreme_test all_vertices.

(** Tetrahedra at boundary triangles are positive. *)
Definition not_mirrored_test (T : list tetrahedron) : bool :=
  forallb (fun t => forallb (fun f => let '(a, b, c) := f in
    negb (contains t [a; b; c]) ||
    existsb (fun u => contains u [a; b; c] && negb (contains u (vertices t))) T ||
    forallb (fun d => mem d [a; b; c] || (0 <? zdet (p a) (p b) (p c) (p d))) (vertices t))
    facet_triangles) T.
End Tests.

(** ** Integers in an ordered field *)

Section Sound.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).

Definition phi : Z -> K := gen_phiZ zero one add mul opp.
Lemma phi_morphism : ring_morph (zero (o := K)) one add mul (fun x y => x - y) opp eq
  0%Z 1%Z Z.add Z.mul Z.sub Z.opp Zeq_bool phi.
Proof. apply gen_phiZ_morph; [apply Eqsth | apply Eq_ext | apply K_ring]. Qed.
Lemma phi_add x y : phi (x + y)%Z = phi x + phi y.
Proof. apply phi_morphism. Qed.
Lemma phi_mul x y : phi (x * y)%Z = phi x * phi y.
Proof. apply phi_morphism. Qed.
Lemma phi_sub x y : phi (x - y)%Z = phi x - phi y.
Proof. apply phi_morphism. Qed.
Lemma phi_opp x : phi (- x)%Z = - phi x.
Proof. apply phi_morphism. Qed.
Lemma phi_0 : phi 0%Z = 0.
Proof. apply phi_morphism. Qed.
Lemma phi_1 : phi 1%Z = 1.
Proof. apply phi_morphism. Qed.
Lemma phi_pos x : (0 < x)%Z -> 0 < phi x.
Proof.
  destruct x as [| n | n]; try discriminate. intros _. induction n as [| n IH] using Pos.peano_ind.
  - rewrite phi_1. apply zero_lt_one.
  - rewrite Pos2Z.inj_succ. unfold Z.succ. rewrite phi_add, phi_1.
    apply pos_add; auto. apply zero_lt_one.
Qed.
Lemma phi_nonneg x : (0 <= x)%Z -> 0 <= phi x.
Proof.
  intro h. apply Z.lt_eq_cases in h as [h | <-].
  - left. now apply phi_pos.
  - right. now rewrite phi_0.
Qed.
Lemma phi_nonzero x : x <> 0%Z -> phi x <> 0.
Proof.
  intros h e. assert (c : (0 < x)%Z \/ (0 < - x)%Z) by lia. destruct c as [c | c]; apply phi_pos in c.
  - rewrite e in c. now apply lt_irrefl in c.
  - rewrite phi_opp, e, opp_zero in c. now apply lt_irrefl in c.
Qed.

Definition image (q : zpoint) : point K := let '(x, y, z) := q in Point (phi x) (phi y) (phi z).
Lemma image_dot a b : dot (image a) (image b) = phi (zdot a b).
Proof.
  destruct a as [[? ?] ?], b as [[? ?] ?]. unfold dot, zdot, image; cbn [px py pz].
  now rewrite !phi_add, !phi_mul.
Qed.
Lemma image_minus a b : image (zminus a b) = minus (image a) (image b).
Proof.
  destruct a as [[? ?] ?], b as [[? ?] ?]. unfold minus, zminus, image; cbn [px py pz].
  now rewrite !phi_sub.
Qed.
Lemma image_det3 a b c : det3 (image a) (image b) (image c) = phi (zdet3 a b c).
Proof.
  destruct a as [[? ?] ?], b as [[? ?] ?], c as [[? ?] ?].
  unfold det3, zdet3, zdot, zcross, image; cbn [px py pz].
  rewrite ?phi_add, ?phi_mul, ?phi_sub, ?phi_mul. ring.
Qed.
Lemma image_det a b c d : det (image a) (image b) (image c) (image d) = phi (zdet a b c d).
Proof. unfold det, zdet. now rewrite <- !image_minus, image_det3. Qed.
Lemma image_value f q : dot (image (fst f)) (image q) + phi (snd f) = phi (value f q).
Proof. unfold value. now rewrite phi_add, image_dot. Qed.

(** ** Separation *)

(** The values of an affine function at the points of a hull. *)
Lemma hull_value (p : vertex -> point K) some x w n e :
  (forall v, ~ some v -> w v = 0) -> sum w = 1 -> combination w p = x ->
  sum (fun v => w v * (dot n (p v) + e)) = dot n x + e.
Proof. intros h1 h2 h3. rewrite affine_combination, h2, h3. ring. Qed.

Theorem separated (p : vertex -> point K) (S T : vertex -> Prop) n e :
  (forall v, S v \/ ~ S v) -> (forall v, T v \/ ~ T v) ->
  (forall v, S v -> 0 <= dot n (p v) + e) ->
  (forall v, T v -> 0 <= - (dot n (p v) + e)) ->
  (forall v, S v -> T v \/ 0 < dot n (p v) + e) ->
  forall x, hull p S x -> hull p T x -> hull p (fun v => S v /\ T v) x.
Proof.
  intros dS dT hS hT strict x (w & w0 & wS & w1 & wx) (u & u0 & uT & u1 & ux).
  assert (nw : forall v, 0 <= w v * (dot n (p v) + e)).
  { intro v. destruct (dS v) as [i | o].
    - apply nonneg_mul; auto.
    - rewrite wS by auto. right. ring. }
  assert (nu : forall v, 0 <= u v * - (dot n (p v) + e)).
  { intro v. destruct (dT v) as [i | o].
    - apply nonneg_mul; auto.
    - rewrite uT by auto. right. ring. }
  (* the value at x is >= 0, since x lies in S, and <= 0, since it lies in T *)
  pose proof (hull_value p S x w n e wS w1 wx) as vw.
  pose proof (hull_value p T x u n e uT u1 ux) as vu.
  assert (zero : sum (fun v => w v * (dot n (p v) + e)) = 0).
  { pose proof (sum_nonneg K _ nw) as h1. pose proof (sum_nonneg K _ nu) as h2.
    assert (h3 : sum (fun v => u v * - (dot n (p v) + e)) = - (dot n x + e)).
    { rewrite <- vu. unfold sum. ring. }
    rewrite h3 in h2. rewrite vw in h1 |- *.
    destruct (nonneg_sum_zero K _ _ h1 h2) as [h _]; auto. ring. }
  pose proof (sum_zero K _ nw zero) as each.
  exists w. repeat split; auto. intros v h. destruct (dS v) as [i | o]; [| now apply wS].
  destruct (strict v i) as [j | pos]; [tauto |].
  apply (mul_zero_cancel K (dot n (p v) + e)); [| now apply pos_neq_zero].
  rewrite <- (each v). ring.
Qed.

Section Placement.
Variable p : vertex -> zpoint.
Definition imaged (v : vertex) : point K := image (p v).

Lemma in_vertices_decidable v (t : tetrahedron) : In v (vertices t) \/ ~ In v (vertices t).
Proof. destruct (in_dec vertex_eq_dec v (vertices t)); auto. Qed.
Lemma separates_sound f s t : separates p f (vertices s) (vertices t) = true ->
  forall x, hull imaged (fun v => In v (vertices s)) x -> hull imaged (fun v => In v (vertices t)) x ->
  hull imaged (fun v => In v (vertices s) /\ In v (vertices t)) x.
Proof.
  unfold separates, weakly_separates. rewrite !andb_true_iff, !forallb_forall.
  intros [[h1 h2] h3]. apply (separated imaged _ _ (image (fst f)) (phi (snd f)));
    try (intro v; apply in_vertices_decidable); intros v i; unfold imaged; rewrite image_value.
  - apply phi_nonneg. apply Z.leb_le. auto.
  - rewrite <- phi_opp. apply phi_nonneg. apply h2 in i. apply Z.leb_le in i. lia.
  - apply h3 in i. apply orb_true_iff in i as [i | i].
    + left. now apply mem_iff.
    + right. now apply phi_pos, Z.ltb_lt.
Qed.
Lemma search_sound planes s t : forall f, search p planes s t f = true ->
  exists g, separates p g s t = true.
Proof.
  induction planes as [| [| a [| b [| c [|]]]] planes IH]; simpl; try discriminate. intro f.
  destruct (weakly_separates p (plane (p a) (p b) (p c)) s t);
    [| destruct (weakly_separates p (negative (plane (p a) (p b) (p c))) s t); [| apply IH]];
    (rewrite orb_true_iff; intros [h | h]; [eauto | now apply IH in h]).
Qed.
Lemma separable_sound s t : separable p s t = true ->
  forall x, hull imaged (fun v => In v (vertices s)) x -> hull imaged (fun v => In v (vertices t)) x ->
  hull imaged (fun v => In v (vertices s) /\ In v (vertices t)) x.
Proof.
  unfold separable. intros h. apply search_sound in h as [f h]. now apply (separates_sound f).
Qed.
Lemma hull_mono (S T : vertex -> Prop) x : (forall v, S v -> T v) -> hull imaged S x -> hull imaged T x.
Proof.
  intros i (w & w1 & w2 & w3). exists w. repeat split; try tauto. intros v o. apply w2. auto.
Qed.

Theorem realizes_test_sound T : realizes_test p T = true -> realizes T imaged.
Proof.
  unfold realizes_test. rewrite andb_true_iff, forallb_forall. intros [hv hs]. constructor.
  - intros t i. apply hv in i. destruct t as [[[a b] c] d]. unfold volume, imaged.
    rewrite image_det. apply phi_nonzero. intro e. unfold zvolume in i. now rewrite e in i.
  - intros s t is_ it x hx hy.
    destruct (all_pairs_sound _ _ _ hs s t is_ it) as [<- | [h | h]].
    + revert hx. apply hull_mono. tauto.
    + now apply (separable_sound s t).
    + apply (hull_mono (fun v => In v (vertices t) /\ In v (vertices s))); [tauto |].
      now apply (separable_sound t s).
Qed.

(** ** Convex position *)

Theorem convex_test_sound : convex_test p = true -> convex_position imaged.
Proof.
  unfold convex_test. rewrite forallb_forall. intros h v (w & w0 & wv & w1 & wx).
  specialize (h v (in_all_vertices v)). unfold extreme_test in h.
  set (f := support p v) in h. clearbody f. apply andb_true_iff in h as [h1 h2].
  apply Z.eqb_eq in h1. rewrite forallb_forall in h2.
  assert (strict : forall u, u <> v -> 0 < dot (image (fst f)) (imaged u) + phi (snd f)).
  { intros u ne. unfold imaged. rewrite image_value. apply phi_pos. apply Z.ltb_lt.
    specialize (h2 u (in_all_vertices u)). apply orb_true_iff in h2 as [e | h2]; auto.
    now apply same_vertex_iff in e. }
  pose proof (hull_value imaged _ _ w (image (fst f)) (phi (snd f)) wv w1 wx) as e.
  unfold imaged at 2 in e. rewrite image_value, h1, phi_0 in e.
  assert (n : forall u, 0 <= w u * (dot (image (fst f)) (imaged u) + phi (snd f))).
  { intro u. destruct (vertex_eq_dec u v) as [-> | ne].
    - rewrite wv by tauto. right. ring.
    - apply nonneg_mul; auto. left. auto. }
  pose proof (sum_zero K _ n e) as each.
  assert (zero : forall u, w u = 0).
  { intro u. destruct (vertex_eq_dec u v) as [-> | ne]; [apply wv; tauto |].
    apply (mul_zero_cancel K (dot (image (fst f)) (imaged u) + phi (snd f))).
    - rewrite <- (each u). ring.
    - apply pos_neq_zero. auto. }
  apply (pos_neq_zero K 1 (zero_lt_one K)). rewrite <- w1. unfold sum. rewrite !zero. ring.
Qed.

(** ** Orientation *)

Theorem not_mirrored_test_sound T : (forall t, In t T -> volume imaged t <> 0) ->
  not_mirrored_test p T = true -> not_mirrored T imaged.
Proof.
  unfold not_mirrored_test. rewrite forallb_forall. intros nd h t a b c d it f perm only.
  specialize (h t it). rewrite forallb_forall in h. specialize (h _ f). cbv beta iota zeta in h.
  assert (i : forall v, In v [a; b; c; d] -> In v (vertices t)).
  { intros v hv. now apply (Permutation_in v perm). }
  assert (in_t : contains t [a; b; c] = true).
  { apply contains_iff. intros v hv. apply i. simpl in *; tauto. }
  rewrite in_t in h. simpl negb in h. apply orb_true_iff in h as [h | h].
  - exfalso. apply existsb_exists in h as (u & iu & h). apply andb_true_iff in h as [h1 h2].
    apply contains_iff, (only u iu) in h1. apply negb_true_iff, not_true_iff_false in h2. apply h2.
    apply contains_iff. intro v. apply Permutation_in. now apply Permutation_sym.
  - rewrite forallb_forall in h. specialize (h d (i d ltac:(simpl; tauto))).
    unfold imaged. rewrite image_det. apply phi_pos, Z.ltb_lt.
    apply orb_true_iff in h as [h | h]; auto. exfalso. apply mem_iff in h.
    assert (n : NoDup [a; b; c; d]).
    { apply Permutation_NoDup with (vertices t); [now apply Permutation_sym |].
      apply (volume_nodup K imaged t (nd t it)). }
    apply (NoDup_remove_2 [a; b; c] [] d) in n. now rewrite app_nil_r in n.
Qed.
End Placement.
End Sound.
Arguments phi {K}.
Arguments image {K}.
Arguments imaged {K}.
