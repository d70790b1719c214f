(** * Vertices inside the hull

    A vertex that is [inside] is neither extreme nor on the boundary of the hull; and where a
    refutation of the clauses "on hull" exists, every realization has such a vertex. *)

From Coq Require Import List Bool Ring.
From Certify Require Import Definitions Barycentric Integral Lrat Formula Signs Polynomials.
Import ListNotations.

Section Convex.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Variable p : vertex -> point K.

(** The weights of a vertex as a combination of itself. *)
Definition delta (v u : vertex) : K := if same_vertex v u then 1 else 0.
Lemma sum_delta v (f : vertex -> K) : sum (fun u => delta v u * f u) = f v.
Proof. destruct v; unfold sum, delta; cbn [same_vertex]; ring. Qed.
Lemma sum_delta_one v : sum (delta v) = 1.
Proof. destruct v; unfold sum, delta; cbn [same_vertex]; ring. Qed.
Lemma combination_delta v : combination (delta v) p = p v.
Proof. unfold combination. rewrite !sum_delta. now destruct (p v). Qed.
Lemma delta_same v : delta v v = 1.
Proof. unfold delta. now rewrite (proj2 (same_vertex_iff v v) eq_refl). Qed.
Lemma delta_other v u : u <> v -> delta v u = 0.
Proof.
  intro ne. unfold delta. destruct (same_vertex v u) eqn:e; auto. apply same_vertex_iff in e. congruence.
Qed.

(** ** What it means to be inside *)

Theorem inside_not_extreme v : inside p v -> ~ extreme p v.
Proof.
  intros (t & w & vol & pos & off_t & w1 & wp) ex. apply ex.
  destruct (in_dec vertex_eq_dec v (vertices t)) as [i | o].
  - exfalso. assert (same : forall u, w u = delta v u).
    { apply (unique K p t); auto.
      - intros u ou. apply delta_other. congruence.
      - now rewrite w1, sum_delta_one.
      - now rewrite wp, combination_delta. }
    pose proof (volume_nodup K p t vol) as nd.
    assert (other : exists u, In u (vertices t) /\ u <> v).
    { destruct t as [[[a b] c] d]. inversion_clear nd as [| ? ? n _]. simpl in n.
      destruct (vertex_eq_dec a v) as [<- | ne]; [exists b | exists a]; simpl; intuition congruence. }
    destruct other as (u & iu & ne). apply pos in iu. rewrite same, delta_other in iu by auto.
    now apply lt_irrefl in iu.
  - exists w. repeat split; auto.
    + intro u. destruct (in_dec vertex_eq_dec u (vertices t)); [left; auto | right; now rewrite off_t].
    + intros u nu. apply off_t. destruct (vertex_eq_dec u v) as [-> | ne]; tauto.
Qed.

Lemma normal_zero (n a b c : point K) : det3 a b c <> 0 ->
  dot n a = 0 -> dot n b = 0 -> dot n c = 0 -> n = origin.
Proof.
  intros d ha hb hc. destruct n as [x y z]. unfold origin.
  assert (cancel : forall k, det3 a b c * k = 0 -> k = 0) by (intros; eapply mul_zero_cancel; eauto).
  set (n := Point x y z) in *.
  assert (ex : det3 a b c * x = dot n a * (py b * pz c - pz b * py c)
    - dot n b * (py a * pz c - pz a * py c) + dot n c * (py a * pz b - pz a * py b)).
  { unfold n. coordinates. }
  assert (ey : det3 a b c * y = - dot n a * (px b * pz c - pz b * px c)
    + dot n b * (px a * pz c - pz a * px c) - dot n c * (px a * pz b - pz a * px b)).
  { unfold n. coordinates. }
  assert (ez : det3 a b c * z = dot n a * (px b * py c - py b * px c)
    - dot n b * (px a * py c - py a * px c) + dot n c * (px a * py b - py a * px b)).
  { unfold n. coordinates. }
  rewrite ha, hb, hc in ex, ey, ez.
  unfold n. f_equal; apply cancel; [rewrite ex | rewrite ey | rewrite ez]; ring.
Qed.
Theorem inside_not_on_hull v : inside p v -> ~ on_hull p v.
Proof.
  intros (t & w & vol & pos & off_t & w1 & wp) (n & nz & side). apply nz.
  assert (value : sum (fun u => w u * (dot n (p u) + - dot n (p v))) = 0).
  { rewrite affine_combination, wp, w1. ring. }
  assert (wn : forall u, 0 <= w u).
  { intro u. destruct (in_dec vertex_eq_dec u (vertices t)); [left; auto | right; now rewrite off_t]. }
  assert (nonneg : forall u, 0 <= w u * (dot n (p u) + - dot n (p v))).
  { intro u. apply nonneg_mul; auto. now apply -> le_sub. }
  pose proof (sum_zero K _ nonneg value) as each.
  assert (level : forall u, In u (vertices t) -> dot n (p u) + - dot n (p v) = 0).
  { intros u i. apply (mul_zero_cancel K (w u)); auto. apply pos_neq_zero. auto. }
  destruct t as [[[a b] c] d]. unfold vertices, volume in *.
  assert (flat : forall u, In u [b; c; d] -> dot n (minus (p u) (p a)) = 0).
  { intros u i. transitivity (dot n (p u) + - dot n (p v) - (dot n (p a) + - dot n (p v))).
    - coordinates.
    - rewrite (level u), (level a) by (simpl in *; tauto). ring. }
  apply (normal_zero n _ _ _ vol); apply flat; simpl; tauto.
Qed.

(** ** The clauses "on hull"

    If the dependence of five points is positive at one of them and negative at the others, or the
    other way round, the one is inside the tetrahedron of the others. *)

Variable g : bool.
Lemma others_in_quintuple q v t u : NoDup (members q) -> In (v, t) (coefficients q) ->
  (In u (vertices t) <-> In u (members q) /\ u <> v).
Proof.
  destruct q as [[[[a b] c] d] e]. unfold members. intro nd.
  repeat match goal with h : NoDup (_ :: _) |- _ => inversion_clear h end. simpl in *.
  intros [i | [i | [i | [i | [i | []]]]]]; injection i as <- <-; simpl; intuition congruence.
Qed.
Lemma inside_quintuple q v s : NoDup (members q) -> In v (members q) ->
  (forall u, In u (members q) -> 0 < signed (if same_vertex u v then s else negb s) (coefficient K p g q u)) ->
  inside p v.
Proof.
  intros nd iv h. pose proof (coefficient_dependence K p g q nd) as [d1 d2].
  set (k := coefficient K p g q) in *.
  assert (kv : 0 < signed s (k v)).
  { pose proof (h v iv) as hv. now rewrite (proj2 (same_vertex_iff v v) eq_refl) in hv. }
  assert (knz : k v <> 0).
  { intro e. rewrite e in kv. apply (lt_irrefl K 0). destruct s; simpl in kv; auto.
    now rewrite opp_zero in kv. }
  destruct (coefficient_exists q v iv) as [t it].
  exists t, (fun u => delta v u - inv (k v) * k u).
  pose proof (coefficient_in K p g q v t nd it) as kt.
  assert (inverse : forall x, 0 < signed (negb s) x -> 0 < - (inv (k v) * x)).
  { intros x hx. apply (pos_cancel K (signed s (k v))); auto.
    assert (e : k v * inv (k v) = 1) by now apply mul_inv.
    replace (signed s (k v) * - (inv (k v) * x)) with ((k v * inv (k v)) * signed (negb s) x).
    - rewrite e. now replace (1 * signed (negb s) x) with (signed (negb s) x) by ring.
    - destruct s; simpl; ring. }
  repeat split.
  - intro e. apply knz. unfold k. rewrite kt. unfold D. rewrite e. destruct g; simpl; auto using opp_zero.
  - intros u iu. apply (others_in_quintuple q v t u nd it) in iu as [iu ne].
    rewrite delta_other by auto. replace (0 - inv (k v) * k u) with (- (inv (k v) * k u)) by ring.
    apply inverse. specialize (h u iu).
    destruct (same_vertex u v) eqn:e; auto. apply same_vertex_iff in e. contradiction.
  - intros u ou. rewrite (others_in_quintuple q v t u nd it) in ou.
    destruct (vertex_eq_dec u v) as [-> | ne].
    + rewrite delta_same. rewrite (mul_comm K (inv _)), (mul_inv K _ knz). ring.
    + rewrite delta_other by auto. unfold k at 2. rewrite coefficient_out by tauto. ring.
  - rewrite sum_sub, sum_delta_one, sum_scale, d1. ring.
  - transitivity (minus (combination (delta v) p) (combination (fun u => inv (k v) * k u) p)).
    + same_point.
    + rewrite combination_delta, combination_scale, d2. destruct (p v) as [x y z].
      unfold minus, origin; cbn [px py pz]. f_equal; ring.
Qed.
Lemma on_hulls_sound c : In c on_hulls -> true_clause p g c \/ exists v, inside p v.
Proof.
  unfold on_hulls. rewrite in_flat_map. intros (q & iq & i). apply quintuples_distinct in iq.
  apply in_flat_map in i. destruct i as (v & iv & i). apply in_map_iff in i as (s & <- & _).
  match goal with |- true_clause p g ?c \/ _ => destruct (true_or_fails K p g c) as [t | f] end; auto.
  right. exists v. apply (inside_quintuple q v s); auto. intros u iu.
  destruct (coefficient_exists q u iu) as [t it]. rewrite (coefficient_in K p g q u t iq it).
  exact (f _ (in_map _ _ _ it)).
Qed.

(** If each of finitely many clauses is true or P holds, then all are true or P holds. *)
Lemma all_true_or (P : Prop) cs : (forall c, In c cs -> true_clause p g c \/ P) ->
  (forall c, In c cs -> true_clause p g c) \/ P.
Proof.
  induction cs as [| c cs IH]; intro h; [left; intros c [] |].
  destruct (h c (or_introl eq_refl)) as [t | t]; auto.
  destruct IH as [IH | IH]; auto.
  - intros d i. apply h. now right.
  - left. intros d [<- | i]; auto.
Qed.

Theorem not_convex_sound T fs proof : realizes T p -> (forall q, first T = Some q -> has p g q true) ->
  refuted_with (on_hulls ++ polynomial_clauses fs) axioms_loaded T proof = true ->
  exists v, inside p v.
Proof.
  intros real hf h. destruct (all_true_or (exists v, inside p v) on_hulls on_hulls_sound) as [t | t]; auto.
  exfalso. apply (refuted_with_sound K p g T real _ _ hf) in h; auto.
  intros c i. apply in_app_iff in i as [i | i]; auto. now apply (polynomial_clauses_sound K p g fs).
Qed.
End Convex.
