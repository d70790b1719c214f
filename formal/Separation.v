(** * Opposite facets that face each other are separated by a plane

    Let J be positive on the cube, and let det A and det B have opposite signs, where A and B are
    the corners of opposite facets. Move from A to B: P(t) = (1-t) A + t B. The determinant of the
    four points P(t) is a cubic polynomial in t that changes sign, so it vanishes for some t between
    0 and 1 (this is where K is assumed to have intermediate values of cubic polynomials). The four
    points then lie in a plane, with normal n; the trilinear map sends the whole section of the
    cube at t into it. At a point of the section J is the determinant of the two derivatives along
    the section, which are orthogonal to n, and the third derivative d; so J would vanish where n d
    does. Hence n d vanishes nowhere on the section, and has one sign. At the corners it is
    n (B_i - A_i): all of A lies on one side of the plane, and all of B on the other. *)

From Coq Require Import List Bool Ring.
From Certify Require Import Definitions Barycentric Integral Lrat Formula Signs Convex Jacobian.
Import ListNotations.

Section Separation.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Hypothesis cubic : cubic_intermediate_values K.

Lemma cubic_root (a b c d : K) : let f t := ((a * t + b) * t + c) * t + d in
  (f 0 < 0 /\ 0 < f 1) \/ (0 < f 0 /\ f 1 < 0) -> exists t, 0 < t /\ t < 1 /\ f t = 0.
Proof.
  intros f [[h0 h1] | [h0 h1]]; [now apply cubic |].
  destruct (cubic (- a) (- b) (- c) (- d)) as (t & t0 & t1 & e).
  - apply neg_opp_pos. match goal with |- 0 < ?x => replace x with (f 0); auto end. unfold f. ring.
  - apply neg_opp_pos in h1. match goal with |- 0 < ?x => replace x with (- f 1); auto end. unfold f. ring.
  - exists t. repeat split; auto. unfold f. rewrite <- (opp_zero K), <- e. ring.
Qed.

(** A linear function without zero on [0,1] has one sign. *)
Lemma one_sign (x y : K) : (forall s, in_unit s -> (1 - s) * x + s * y <> 0) -> 0 < x -> 0 < y.
Proof.
  intros nz hx. destruct (trichotomy K y) as [h | [h | h]]; auto; exfalso.
  - apply (nz 1 (in_unit_one K)). rewrite h. ring.
  - assert (hd : 0 < x + - y) by now apply pos_add.
    assert (hi : 0 < inv (x + - y)) by now apply inv_pos.
    assert (e : (x + - y) * inv (x + - y) = 1) by now apply mul_inv, pos_neq_zero.
    set (i := inv (x + - y)) in *. assert (e1 : 1 - x * i = - y * i) by (rewrite <- e; ring).
    apply (nz (x * i)).
    + split; [left; now apply lt_mul |]. apply <- le_sub. rewrite e1. left. now apply lt_mul.
    + rewrite e1. ring.
Qed.

(** ** One pair of facets

    A b c and B b c are the corners of the two facets at the place (b, c) of the section. *)

Section Facets.
Variables A B : bool -> bool -> point K.

Definition P (t : K) (b c : bool) : point K :=
  Point ((1 - t) * px (A b c) + t * px (B b c)) ((1 - t) * py (A b c) + t * py (B b c))
    ((1 - t) * pz (A b c) + t * pz (B b c)).
Definition mix2 (t : K) (x y : point K) : point K :=
  Point ((1 - t) * px x + t * px y) ((1 - t) * py x + t * py y) ((1 - t) * pz x + t * pz y).

(** The derivatives at (t, s, u): along the edges from A to B, and along the section. *)
Definition along (s u : K) : point K :=
  mix2 u (mix2 s (minus (B false false) (A false false)) (minus (B true false) (A true false)))
    (mix2 s (minus (B false true) (A false true)) (minus (B true true) (A true true))).
Definition d_s (t u : K) : point K :=
  mix2 u (minus (P t true false) (P t false false)) (minus (P t true true) (P t false true)).
Definition d_u (t s : K) : point K :=
  mix2 s (minus (P t false true) (P t false false)) (minus (P t true true) (P t true false)).

Hypothesis positive : forall t s u, in_unit t -> in_unit s -> in_unit u ->
  0 < det3 (along s u) (d_s t u) (d_u t s).

Definition D (t : K) : K := det (P t false false) (P t true false) (P t false true) (P t true true).
Lemma D_cubic : exists a b c d, forall t, D t = ((a * t + b) * t + c) * t + d.
Proof.
  set (x0 := minus (A true false) (A false false)). set (y0 := minus (A false true) (A false false)).
  set (z0 := minus (A true true) (A false false)).
  set (x1 := minus (minus (B true false) (B false false)) x0).
  set (y1 := minus (minus (B false true) (B false false)) y0).
  set (z1 := minus (minus (B true true) (B false false)) z0).
  exists (det3 x1 y1 z1), (det3 x0 y1 z1 + det3 x1 y0 z1 + det3 x1 y1 z0),
    (det3 x1 y0 z0 + det3 x0 y1 z0 + det3 x0 y0 z1), (det3 x0 y0 z0).
  intro t. unfold D, det.
  assert (e : forall b c, minus (P t b c) (P t false false) =
    Point (px (minus (A b c) (A false false)) + t * px (minus (minus (B b c) (B false false)) (minus (A b c) (A false false))))
      (py (minus (A b c) (A false false)) + t * py (minus (minus (B b c) (B false false)) (minus (A b c) (A false false))))
      (pz (minus (A b c) (A false false)) + t * pz (minus (minus (B b c) (B false false)) (minus (A b c) (A false false))))).
  { intros b c. unfold P. same_point. }
  rewrite !e. fold x0 y0 z0. fold x1 y1 z1. clearbody x0 y0 z0 x1 y1 z1. coordinates.
Qed.

Section Level.
(** A place t where the section is flat. *)
Variable t : K.
Hypothesis t_pos : 0 < t.
Hypothesis t_lt_one : t < 1.
Hypothesis flat : D t = 0.

Definition n : point K := cross K (minus (P t true false) (P t false false)) (minus (P t false true) (P t false false)).
Definition e (b c : bool) : K := dot n (minus (B b c) (A b c)).

Lemma in_unit_t : in_unit t.
Proof. split; now left. Qed.
Lemma n_orthogonal b c : dot n (minus (P t b c) (P t false false)) = 0.
Proof.
  unfold n, cross. destruct b, c.
  - rewrite <- flat. unfold D. generalize (P t true false) (P t false false) (P t false true) (P t true true).
    intros. coordinates.
  - generalize (P t true false) (P t false false) (P t false true). intros. coordinates.
  - generalize (P t true false) (P t false false) (P t false true). intros. coordinates.
  - generalize (P t true false) (P t false false) (P t false true). intros. coordinates.
Qed.
Lemma n_difference b c b' c' : dot n (minus (P t b c) (P t b' c')) = 0.
Proof.
  transitivity (dot n (minus (P t b c) (P t false false)) - dot n (minus (P t b' c') (P t false false))).
  - generalize n (P t b c) (P t b' c') (P t false false). intros. coordinates.
  - rewrite !n_orthogonal. ring.
Qed.
Lemma dot_mix2 x s y z : dot x (mix2 s y z) = (1 - s) * dot x y + s * dot x z.
Proof. unfold mix2. coordinates. Qed.
Lemma n_nonzero : n <> origin.
Proof.
  intro z. apply (lt_irrefl K 0).
  replace 0 with (det3 (along 0 0) (d_s t 0) (d_u t 0)) at 2.
  - apply positive; auto using in_unit_zero, in_unit_t.
  - transitivity (dot n (along 0 0)); [| rewrite z; coordinates].
    unfold n, cross, d_s, d_u, mix2. generalize (along 0 0) (P t).
    intros v Q. coordinates.
Qed.
Lemma along_nonzero s u : in_unit s -> in_unit u -> dot n (along s u) <> 0.
Proof.
  intros hs hu z. apply n_nonzero.
  apply (normal_zero K n (along s u) (d_s t u) (d_u t s)); auto.
  - apply pos_neq_zero. auto using in_unit_t.
  - unfold d_s. rewrite dot_mix2, !n_difference. ring.
  - unfold d_u. rewrite dot_mix2, !n_difference. ring.
Qed.
Lemma dot_along s u : dot n (along s u) =
  (1 - u) * ((1 - s) * e false false + s * e true false) + u * ((1 - s) * e false true + s * e true true).
Proof. unfold along, e. now rewrite !dot_mix2. Qed.

(** All four corners have the sign of the first. *)
Lemma corners_positive b c : 0 < e false false -> 0 < e b c.
Proof.
  intro h.
  assert (h1 : 0 < e true false).
  { apply (one_sign (e false false)); auto. intros s hs z.
    apply (along_nonzero s 0 hs (in_unit_zero K)). rewrite dot_along. rewrite z. ring. }
  assert (h2 : 0 < e false true).
  { apply (one_sign (e false false)); auto. intros u hu z.
    apply (along_nonzero 0 u (in_unit_zero K) hu). rewrite dot_along.
    transitivity ((1 - u) * e false false + u * e false true); [ring | exact z]. }
  assert (h3 : 0 < e true true).
  { apply (one_sign (e false true)); auto. intros s hs z.
    apply (along_nonzero s 1 hs (in_unit_one K)). rewrite dot_along. rewrite z. ring. }
  destruct b, c; auto.
Qed.
Lemma corners_negative b c : 0 < - e false false -> 0 < - e b c.
Proof.
  intro h.
  assert (neg : forall x y : K, (forall s, in_unit s -> (1 - s) * x + s * y <> 0) -> 0 < - x -> 0 < - y).
  { intros x y hz. apply one_sign. intros s hs z. apply (hz s hs).
    transitivity (- ((1 - s) * - x + s * - y)); [ring | rewrite z; ring]. }
  assert (h1 : 0 < - e true false).
  { apply (neg (e false false)); auto. intros s hs z.
    apply (along_nonzero s 0 hs (in_unit_zero K)). rewrite dot_along. rewrite z. ring. }
  assert (h2 : 0 < - e false true).
  { apply (neg (e false false)); auto. intros u hu z.
    apply (along_nonzero 0 u (in_unit_zero K) hu). rewrite dot_along.
    transitivity ((1 - u) * e false false + u * e false true); [ring | exact z]. }
  assert (h3 : 0 < - e true true).
  { apply (neg (e false true)); auto. intros s hs z.
    apply (along_nonzero s 1 hs (in_unit_one K)). rewrite dot_along. rewrite z. ring. }
  destruct b, c; auto.
Qed.

Definition level : K := dot n (P t false false).
Lemma on_level b c : dot n (P t b c) = level.
Proof.
  apply sub_zero_eq. unfold level. rewrite <- (n_orthogonal b c).
  generalize n (P t b c) (P t false false). intros. coordinates.
Qed.
Lemma below b c : level - dot n (A b c) = t * e b c.
Proof. rewrite <- (on_level b c). unfold e, P. generalize n. intro m. coordinates. Qed.
Lemma above b c : dot n (B b c) - level = (1 - t) * e b c.
Proof. rewrite <- (on_level b c). unfold e, P. generalize n. intro m. coordinates. Qed.

Lemma separated_at_level : exists m h, forall b c, 0 < h - dot m (A b c) /\ 0 < dot m (B b c) - h.
Proof.
  assert (u : 0 < 1 - t) by now apply -> lt_sub.
  destruct (trichotomy K (e false false)) as [h | [h | h]].
  - exists n, level. intros b c. rewrite below, above.
    split; apply lt_mul; auto; now apply corners_positive.
  - exfalso. apply (along_nonzero 0 0 (in_unit_zero K) (in_unit_zero K)). rewrite dot_along, h. ring.
  - exists (minus origin n), (- level). intros b c.
    replace (- level - dot (minus origin n) (A b c)) with (- (level - dot n (A b c)))
      by (generalize n level; intros; coordinates).
    replace (dot (minus origin n) (B b c) - - level) with (- (dot n (B b c) - level))
      by (generalize n level; intros; coordinates).
    rewrite below, above. split.
    + replace (- (t * e b c)) with (t * - e b c) by ring. apply lt_mul; auto. now apply corners_negative.
    + replace (- ((1 - t) * e b c)) with ((1 - t) * - e b c) by ring.
      apply lt_mul; auto. now apply corners_negative.
Qed.
End Level.

Theorem facets_separated :
  (D 0 < 0 /\ 0 < D 1) \/ (0 < D 0 /\ D 1 < 0) ->
  exists m h, forall b c, 0 < h - dot m (A b c) /\ 0 < dot m (B b c) - h.
Proof.
  intro h. destruct D_cubic as (a & b & c & d & e). rewrite !e in h.
  apply cubic_root in h as (t & t0 & t1 & z). cbv zeta in z. rewrite <- e in z.
  now apply (separated_at_level t).
Qed.
End Facets.

(** ** The trilinear map, section by section along the axis i *)

Variable p : vertex -> point K.
Hypothesis positive : positive_jacobian p.

Definition triple (i j k : axis) : Prop :=
  In (i, j, k) [(Axis_r, Axis_s, Axis_t); (Axis_s, Axis_t, Axis_r); (Axis_t, Axis_r, Axis_s)].
Definition section_vertex (i j k : axis) (side b c : bool) : vertex :=
  let v := if side then across i V1 else V1 in
  let v := if b then across j v else v in
  if c then across k v else v.
Definition section_point (i j k : axis) (side b c : bool) : point K := p (section_vertex i j k side b c).

Lemma det3_cyclic (a b c : point K) : det3 a b c = det3 b c a.
Proof. coordinates. Qed.
Ltac derivatives :=
  unfold along, d_s, d_u, P, mix2, section_point, derivative_r, derivative_s, derivative_t;
  cbv [section_vertex across find flip negb same_corner corner eqb andb all_vertices];
  unfold combination, sum, minus; cbn [corner factor slope px py pz]; f_equal; ring.
Lemma section_positive i j k t s u : triple i j k -> in_unit t -> in_unit s -> in_unit u ->
  let A := section_point i j k false in let B := section_point i j k true in
  0 < det3 (along A B s u) (d_s A B t u) (d_u A B t s).
Proof.
  intros [e | [e | [e | []]]] ht hs hu; injection e as <- <- <-; cbv zeta.
  - replace (det3 _ _ _) with (jacobian p t s u); [now apply positive |]. unfold jacobian.
    f_equal; derivatives.
  - replace (det3 _ _ _) with (jacobian p u t s); [now apply positive |]. unfold jacobian.
    rewrite det3_cyclic. f_equal; derivatives.
  - replace (det3 _ _ _) with (jacobian p s u t); [now apply positive |]. unfold jacobian.
    rewrite <- det3_cyclic. f_equal; derivatives.
Qed.
Lemma section_start i j k :
  D (section_point i j k false) (section_point i j k true) 0 = volume p (facet_across i j k false).
Proof. unfold D, P, section_point, facet_across, section_vertex, volume. coordinates. Qed.
Lemma section_end i j k :
  D (section_point i j k false) (section_point i j k true) 1 = volume p (facet_across i j k true).
Proof. unfold D, P, section_point, facet_across, section_vertex, volume. coordinates. Qed.

(** ** The clauses *)

Lemma no_circuit_across (c : vertex -> K) (f h : vertex -> Prop) n e : dependence p c ->
  (forall v, 0 < c v -> f v) -> (forall v, 0 < - c v -> h v) ->
  (forall v, f v -> 0 < - (dot n (p v) + e)) -> (forall v, h v -> 0 < dot n (p v) + e) ->
  forall v, c v = 0.
Proof.
  intros dep hf hh nf nh. pose proof (dependence_affine K p c n e dep) as zero.
  assert (nonneg : forall v, 0 <= - (c v * (dot n (p v) + e))).
  { intro v. destruct (trichotomy K (c v)) as [k | [k | k]].
    - replace (- (c v * (dot n (p v) + e))) with (c v * - (dot n (p v) + e)) by ring.
      left. apply lt_mul; auto.
    - rewrite k. right. ring.
    - replace (- (c v * (dot n (p v) + e))) with (- c v * (dot n (p v) + e)) by ring.
      left. apply lt_mul; auto. }
  assert (each : forall v, - (c v * (dot n (p v) + e)) = 0).
  { apply (sum_zero K _ nonneg). transitivity (- sum (fun v => c v * (dot n (p v) + e))).
    - unfold sum. ring.
    - rewrite zero. ring. }
  intro v. destruct (trichotomy K (c v)) as [k | [k | k]]; auto; exfalso.
  - apply (pos_neq_zero K (c v * - (dot n (p v) + e))).
    + apply lt_mul; auto.
    + rewrite <- (each v). ring.
  - apply (pos_neq_zero K (- c v * (dot n (p v) + e))).
    + apply lt_mul; auto.
    + rewrite <- (each v). ring.
Qed.

Lemma in_facet i j k side v :
  In v (vertices (facet_across i j k side)) -> exists b c, v = section_vertex i j k side b c.
Proof.
  intro h. unfold facet_across in h. simpl in h. unfold section_vertex.
  destruct h as [h | [h | [h | [h | []]]]]; subst.
  - now exists false, false.
  - now exists true, false.
  - now exists false, true.
  - now exists true, true.
Qed.

Lemma separations_sound c : In c separations -> true_clause p true c.
Proof.
  unfold separations. rewrite in_flat_map. intros ([[i j] k] & ijk & h). apply in_flat_map in h.
  destruct h as (s & _ & h). apply in_flat_map in h. destruct h as (q & iq & h).
  apply in_map_iff in h as (cl & <- & icl). apply quintuples_distinct in iq.
  apply by_contradiction. intro fail.
  pose proof (fail _ (or_introl eq_refl)) as hA. pose proof (fail _ (or_intror (or_introl eq_refl))) as hB.
  cbn [fails] in hA, hB. unfold has, Signs.D in hA, hB. cbn [Signs.signed] in hA, hB.
  set (A := section_point i j k false). set (B := section_point i j k true).
  destruct (facets_separated A B (fun t s u => section_positive i j k t s u ijk)) as (m & e & sep).
  { unfold A, B. rewrite section_start, section_end. destruct s; simpl in hA, hB.
    - right. split; auto. now apply neg_opp_pos.
    - left. split; auto. now apply neg_opp_pos. }
  assert (onA : forall v, In v (vertices (facet_across i j k false)) -> 0 < e - dot m (p v)).
  { intros v iv. apply in_facet in iv as (b & c & ->). apply (sep b c). }
  assert (onB : forall v, In v (vertices (facet_across i j k true)) -> 0 < dot m (p v) - e).
  { intros v iv. apply in_facet in iv as (b & c & ->). apply (sep b c). }
  assert (t : true_clause p true cl).
  { assert (side : forall v l, In v (filter (fun v => mem v l) (members q)) -> In v l).
    { intros v l iv. apply filter_In in iv as [_ iv]. now apply mem_iff. }
    apply in_app_iff in icl as [icl | icl]; (eapply overlap_true; [exact iq | | exact icl]); intros hf hg.
    - apply (no_circuit_across _ _ _ m (- e) (coefficient_dependence K p true q iq) hf hg);
        intros v iv; apply side in iv.
      + replace (- (dot m (p v) + - e)) with (e - dot m (p v)) by ring. auto.
      + auto.
    - apply (no_circuit_across _ _ _ (minus origin m) e (coefficient_dependence K p true q iq) hf hg);
        intros v iv; apply side in iv.
      + replace (- (dot (minus origin m) (p v) + e)) with (dot m (p v) - e) by coordinates. auto.
      + replace (dot (minus origin m) (p v) + e) with (e - dot m (p v)) by coordinates. auto. }
  destruct t as (l & il & holds_l).
  specialize (fail l (or_intror (or_intror il))). destruct l; simpl in *; contradiction.
Qed.
End Separation.
