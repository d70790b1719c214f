(** * Affine dependences and barycentric coordinates

    A dependence of the eight points p_1, ..., p_8 is a family of coefficients u_1, ..., u_8 with
    sum u_v = 0 and sum u_v p_v = 0. Two facts are proved that everything else rests on:

    - barycentric coordinates in a tetrahedron that is not degenerate are unique ([unique]);
    - where tetrahedra are realized, no dependence other than zero is positive only on the vertices
      of one tetrahedron and negative only on those of one, the same or another ([no_overlap]). *)

From Coq Require Import List Bool Permutation Ring.
From Certify Require Import Definitions.
Import ListNotations.

Definition vertex_eq_dec (v w : vertex) : {v = w} + {v <> w}.
Proof. decide equality. Defined.
Definition all_vertices : list vertex := [V1; V2; V3; V4; V5; V6; V7; V8].
Lemma in_all_vertices v : In v all_vertices.
Proof. destruct v; simpl; tauto. Qed.
Lemma all_vertices_nodup : NoDup all_vertices.
Proof. repeat constructor; simpl; intuition discriminate. Qed.

(** Finite choice: what exists for each of the eight vertices can be chosen for all at once. *)
Lemma choose (A : Type) (P : vertex -> A -> Prop) :
  (forall v, exists y, P v y) -> exists f : vertex -> A, forall v, P v (f v).
Proof.
  intro h. destruct (h V1) as [y1 h1], (h V2) as [y2 h2], (h V3) as [y3 h3], (h V4) as [y4 h4],
    (h V5) as [y5 h5], (h V6) as [y6 h6], (h V7) as [y7 h7], (h V8) as [y8 h8].
  exists (fun v => match v with V1 => y1 | V2 => y2 | V3 => y3 | V4 => y4
                              | V5 => y5 | V6 => y6 | V7 => y7 | V8 => y8 end).
  now intros [].
Qed.

(** Identities between coordinates, once everything is written out. *)
Ltac coordinates :=
  unfold det, det3, dot, combination, minus, origin, sum; cbn [px py pz]; try ring.
Ltac same_point := unfold combination, minus, origin, sum; cbn [px py pz]; f_equal; try ring.

Section Barycentric.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Implicit Types (f g u w : vertex -> K) (p : vertex -> point K).

(** ** Sums over the vertices *)

Lemma sum_ext f g : (forall v, f v = g v) -> sum f = sum g.
Proof. intro h. unfold sum. now rewrite !h. Qed.
Lemma sum_sub f g : sum (fun v => f v - g v) = sum f - sum g.
Proof. unfold sum. ring. Qed.
Lemma sum_scale (c : K) f : sum (fun v => c * f v) = c * sum f.
Proof. unfold sum. ring. Qed.
Lemma sum_nonneg f : (forall v, 0 <= f v) -> 0 <= sum f.
Proof. intro h. unfold sum. repeat apply nonneg_add; auto. Qed.

(** The sum over a list of vertices; a function that vanishes off the list has no other sum. *)
Fixpoint list_sum (l : list vertex) f : K :=
  match l with [] => 0 | v :: l' => f v + list_sum l' f end.
Lemma sum_is_list_sum f : sum f = list_sum all_vertices f.
Proof. unfold sum, all_vertices; simpl. ring. Qed.
Lemma list_sum_perm l m f : Permutation l m -> list_sum l f = list_sum m f.
Proof. induction 1; simpl; congruence || ring. Qed.
Lemma list_sum_app l m f : list_sum (l ++ m) f = list_sum l f + list_sum m f.
Proof. induction l as [| v l IH]; simpl; [| rewrite IH]; ring. Qed.
Lemma list_sum_zero l f : (forall v, In v l -> f v = 0) -> list_sum l f = 0.
Proof.
  induction l as [| v l IH]; simpl; intro h; auto. rewrite h, IH by auto. ring.
Qed.
Lemma complement l : NoDup l -> exists m, Permutation all_vertices (l ++ m) /\
  forall v, In v m -> ~ In v l.
Proof.
  intro hl. pose (out v := if in_dec vertex_eq_dec v l then false else true).
  assert (ho : forall v, In v (filter out all_vertices) -> ~ In v l).
  { intros v h. apply filter_In in h as [_ h]. unfold out in h. now destruct in_dec. }
  exists (filter out all_vertices). split; auto.
  apply NoDup_Permutation; [apply all_vertices_nodup | |].
  - assert (hf : NoDup (filter out all_vertices)) by apply NoDup_filter, all_vertices_nodup.
    revert hf ho. generalize (filter out all_vertices). intros m hm ho. clear out.
    induction hl as [| v l n hl IH]; simpl; auto. constructor.
    + rewrite in_app_iff. intros [h | h]; auto. apply (ho v h). now left.
    + apply IH. intros w h i. apply (ho w h). now right.
  - intro v. split; intros _; [| apply in_all_vertices]. rewrite in_app_iff, filter_In.
    pose proof (in_all_vertices v). unfold out. destruct (in_dec vertex_eq_dec v l); auto.
Qed.
Lemma sum_support l f : NoDup l -> (forall v, ~ In v l -> f v = 0) -> sum f = list_sum l f.
Proof.
  intros hl hf. destruct (complement l hl) as (m & hp & hm).
  rewrite sum_is_list_sum, (list_sum_perm _ _ _ hp), list_sum_app, (list_sum_zero m); [ring |].
  auto.
Qed.
Lemma sum_zero f : (forall v, 0 <= f v) -> sum f = 0 -> forall v, f v = 0.
Proof.
  intros h e v. rewrite sum_is_list_sum in e. generalize (in_all_vertices v). revert e.
  generalize all_vertices. induction l as [| w l IH]; simpl; [tauto |]. intros e i.
  assert (n : 0 <= list_sum l f).
  { clear - h. induction l; simpl; [apply nonneg_refl | now apply nonneg_add]. }
  apply nonneg_sum_zero in e as [e1 e2]; auto. destruct i as [<- | i]; auto.
Qed.

(** ** Affine functions

    An affine function is q |-> n q + e. On a combination it is the combination of its values. *)

Lemma affine_combination p w (n : point K) (e : K) :
  sum (fun v => w v * (dot n (p v) + e)) = dot n (combination w p) + sum w * e.
Proof. coordinates. Qed.

Definition cross (a b : point K) : point K :=
  Point (py a * pz b - pz a * py b) (pz a * px b - px a * pz b) (px a * py b - py a * px b).
Definition normal (a b c : point K) : point K := cross (minus b a) (minus c a).

(** The determinant of four points is an affine function of the last one. *)
Lemma det_affine (a b c q : point K) : det a b c q = dot (normal a b c) q + - dot (normal a b c) a.
Proof. unfold normal, cross. coordinates. Qed.

Lemma det_swap_ad (a b c d : point K) : det d b c a = - det a b c d.
Proof. coordinates. Qed.
Lemma det_swap_bd (a b c d : point K) : det a d c b = - det a b c d.
Proof. coordinates. Qed.
Lemma det_swap_cd (a b c d : point K) : det a b d c = - det a b c d.
Proof. coordinates. Qed.

(** ** Dependences *)

Definition dependence p u : Prop := sum u = 0 /\ combination u p = origin.

Lemma dependence_affine p u n e : dependence p u -> sum (fun v => u v * (dot n (p v) + e)) = 0.
Proof. intros [h1 h2]. rewrite affine_combination, h1, h2. coordinates. Qed.
Lemma dependence_det p u a b c : dependence p u -> sum (fun v => u v * det a b c (p v)) = 0.
Proof.
  intro h. rewrite <- (dependence_affine p u (normal a b c) (- dot (normal a b c) a) h).
  apply sum_ext. intro v. now rewrite det_affine.
Qed.
Lemma minus_origin (a b : point K) : minus a b = origin -> a = b.
Proof.
  destruct a as [xa ya za], b as [xb yb zb]. unfold minus, origin; cbn [px py pz].
  intros [= hx hy hz]. f_equal; now apply sub_zero_eq.
Qed.
Lemma difference_dependence p u w :
  sum u = sum w -> combination u p = combination w p -> dependence p (fun v => u v - w v).
Proof.
  intros h1 h2. split.
  - rewrite sum_sub, h1. ring.
  - transitivity (minus (combination u p) (combination w p)); [| rewrite h2]; same_point.
Qed.

Lemma volume_nodup p t : volume p t <> 0 -> NoDup (vertices t).
Proof.
  destruct t as [[[a b] c] d]; unfold volume, vertices. intro h.
  repeat constructor; simpl; intro e; apply h; unfold det, det3, minus; cbn [px py pz];
    repeat match goal with H : _ \/ _ |- _ => destruct H end; subst; try tauto; ring.
Qed.

(** The vertices of a tetrahedron that is not degenerate have no dependence: the function
    q |-> det(a, b, c, q) vanishes at a, b and c, but not at d. *)
Lemma independent p t u : volume p t <> 0 ->
  (forall v, ~ In v (vertices t) -> u v = 0) -> dependence p u -> forall v, u v = 0.
Proof.
  intros ht hu hd v. pose proof (volume_nodup p t ht) as nd.
  destruct (in_dec vertex_eq_dec v (vertices t)) as [i | o]; [| now apply hu].
  assert (e : forall a b c, list_sum (vertices t) (fun v => u v * det a b c (p v)) = 0).
  { intros a b c. rewrite <- (dependence_det p u a b c hd). symmetry. apply sum_support; auto.
    intros w hw. rewrite (hu w hw). ring. }
  destruct t as [[[a b] c] d]; unfold volume, vertices in *. cbn [list_sum] in e.
  assert (cancel : forall x : K, det (p a) (p b) (p c) (p d) * x = 0 -> x = 0).
  { intros x hx. now apply (mul_zero_cancel _ _ _ hx). }
  destruct i as [<- | [<- | [<- | [<- | []]]]]; apply cancel.
  - rewrite <- opp_zero, <- (e (p d) (p b) (p c)). coordinates.
  - rewrite <- opp_zero, <- (e (p a) (p d) (p c)). coordinates.
  - rewrite <- opp_zero, <- (e (p a) (p b) (p d)). coordinates.
  - rewrite <- (e (p a) (p b) (p c)). coordinates.
Qed.
Lemma unique p t u w : volume p t <> 0 ->
  (forall v, ~ In v (vertices t) -> u v = 0) -> (forall v, ~ In v (vertices t) -> w v = 0) ->
  sum u = sum w -> combination u p = combination w p -> forall v, u v = w v.
Proof.
  intros ht hu hw h1 h2 v. apply sub_zero_eq.
  apply (independent p t (fun v => u v - w v) ht); auto using difference_dependence.
  intros x hx. rewrite hu, hw by auto. ring.
Qed.

(** ** The lemma behind the clauses "no overlap"

    Let a dependence c be positive only on S and negative only on T. Write c = c+ - c-. After
    scaling, c+ and c- are barycentric coordinates of one point x, in S and in T. As the
    tetrahedra meet properly, x has coordinates w on the common vertices too. In S, and in T,
    coordinates are unique: c+ = w = c-, so that c = 0. *)

Lemma parts c : exists a b : vertex -> K, forall v,
  c v = a v - b v /\ 0 <= a v /\ 0 <= b v /\
  (0 < c v \/ a v = 0) /\ (0 < - c v \/ b v = 0).
Proof.
  destruct (choose (K * K) (fun v y => c v = fst y - snd y /\ 0 <= fst y /\ 0 <= snd y /\
    (0 < c v \/ fst y = 0) /\ (0 < - c v \/ snd y = 0))) as [f h].
  - intro v. destruct (trichotomy K (c v)) as [h | [h | h]].
    + exists (c v, 0). simpl. repeat split; auto; [ring | now left | now right].
    + exists (0, 0). simpl. rewrite h. repeat split; auto; (ring || now right).
    + exists (0, - c v). simpl. repeat split; auto; [ring | now right | now left].
  - exists (fun v => fst (f v)), (fun v => snd (f v)). exact h.
Qed.
Lemma combination_scale (r : K) w p :
  combination (fun v => r * w v) p =
  Point (r * px (combination w p)) (r * py (combination w p)) (r * pz (combination w p)).
Proof. same_point. Qed.

Theorem no_overlap T p s t c : realizes T p -> In s T -> In t T -> dependence p c ->
  (forall v, 0 < c v -> In v (vertices s)) -> (forall v, 0 < - c v -> In v (vertices t)) ->
  forall v, c v = 0.
Proof.
  intros [nd meet] hs ht [d1 d2] hp hn.
  destruct (parts c) as (a & b & h).
  assert (na : forall v, 0 <= a v) by (intro v; apply h).
  assert (nb : forall v, 0 <= b v) by (intro v; apply h).
  assert (oa : forall v, ~ In v (vertices s) -> a v = 0).
  { intros v o. destruct (h v) as (_ & _ & _ & [i | e] & _); auto. now apply hp in i. }
  assert (ob : forall v, ~ In v (vertices t) -> b v = 0).
  { intros v o. destruct (h v) as (_ & _ & _ & _ & [i | e]); auto. now apply hn in i. }
  assert (e1 : sum a = sum b).
  { apply sub_zero_eq. rewrite <- sum_sub, <- d1. apply sum_ext. intro v. now destruct (h v). }
  assert (e2 : combination a p = combination b p).
  { assert (e : minus (combination a p) (combination b p) = origin).
    { rewrite <- d2. transitivity (combination (fun v => a v - b v) p); [same_point |].
      unfold combination. f_equal; apply sum_ext; intro v; destruct (h v) as [-> _]; ring. }
    now apply minus_origin. }
  destruct (sum_nonneg a na) as [pos | zero].
  2:{ intro v. destruct (h v) as [-> _].
      rewrite (sum_zero a na (eq_sym zero) v), (sum_zero b nb (eq_trans (eq_sym e1) (eq_sym zero)) v).
      ring. }
  set (r := inv (sum a)).
  assert (hr : 0 < r) by now apply inv_pos.
  assert (one_a : sum (fun v => r * a v) = 1).
  { rewrite sum_scale, mul_comm. now apply mul_inv, pos_neq_zero. }
  assert (one_b : sum (fun v => r * b v) = 1) by now rewrite sum_scale, <- e1, <- sum_scale.
  assert (in_hull : forall (y : vertex -> K) q, (forall v, 0 <= y v) ->
    (forall v, ~ In v (vertices q) -> y v = 0) -> sum (fun v => r * y v) = 1 ->
    hull p (fun v => In v (vertices q)) (combination (fun v => r * y v) p)).
  { intros y q ny oy sy. exists (fun v => r * y v). repeat split; auto.
    - intro v. apply nonneg_mul; auto. now left.
    - intros v o. rewrite oy by auto. ring. }
  destruct (meet s t hs ht (combination (fun v => r * a v) p)) as (w & _ & ow & w1 & w2).
  - now apply in_hull.
  - rewrite combination_scale, e2, <- combination_scale. now apply in_hull.
  - assert (wa : forall v, r * a v = w v).
    { apply (unique p s); auto; try congruence.
      - intros v o. rewrite oa by auto. ring.
      - intros v o. apply ow. tauto. }
    assert (wb : forall v, r * b v = w v).
    { apply (unique p t); auto; try congruence.
      - intros v o. rewrite ob by auto. ring.
      - intros v o. apply ow. tauto.
      - now rewrite combination_scale, <- e2, <- combination_scale. }
    intro v. apply (mul_zero_cancel K r); [| now apply pos_neq_zero].
    destruct (h v) as [-> _]. replace (r * (a v - b v)) with (r * a v - r * b v) by ring.
    rewrite wa, wb. ring.
Qed.
End Barycentric.

Arguments dependence {K}.
Arguments normal {K}.
