(** * The Jacobian of the trilinear map

    J has degree two in each variable. With m_0 = (1-t)^2, m_1 = t(1-t), m_2 = t^2 it is the sum of
    m_i(r) m_j(s) m_k(t) C_ijk over i, j, k = 0, 1, 2, where C_ijk is a sum of determinants of
    edges: a positive multiple of the Bernstein coefficient. On [0,1] the m are >= 0 and not all
    zero. So if the 27 coefficients are positive, J is positive on the cube
    ([positive_jacobian_test_sound]).

    Conversely, where J is positive, certain clauses about signs of determinants hold: at the
    corners ([corners_sound]) and along the edges of the cube ([edges_sound]). *)

From Coq Require Import List Bool ZArith Ring.
From Certify Require Import Definitions Barycentric Integral Lrat Formula Signs.
Import ListNotations.

(** ** Coefficients *)

(** The vertex at a corner. *)
Definition vertex_at (a b c : bool) : vertex :=
  match a, b, c with
  | false, false, false => V1 | true, false, false => V2 | true, true, false => V3
  | false, true, false => V4 | false, false, true => V5 | true, false, true => V6
  | true, true, true => V7 | false, true, true => V8
  end.

(** i = 0, 1, 2 as a sum of two bits. *)
Inductive index : Type := I0 | I1 | I2.
Definition bit_pairs (i : index) : list (bool * bool) :=
  match i with
  | I0 => [(false, false)]
  | I1 => [(false, true); (true, false)]
  | I2 => [(true, true)]
  end.

Section Integers.
Variable p : vertex -> zpoint.
Definition zedge_r (b c : bool) : zpoint := zminus (p (vertex_at true b c)) (p (vertex_at false b c)).
Definition zedge_s (a c : bool) : zpoint := zminus (p (vertex_at a true c)) (p (vertex_at a false c)).
Definition zedge_t (a b : bool) : zpoint := zminus (p (vertex_at a b true)) (p (vertex_at a b false)).
Definition ztotal (l : list Z) : Z := fold_right Z.add 0%Z l.
Definition zbernstein (i j k : index) : Z :=
  ztotal (map (fun a => ztotal (map (fun b => ztotal (map (fun c =>
    zdet3 (zedge_r (fst b) (fst c)) (zedge_s (fst a) (snd c)) (zedge_t (snd a) (snd b)))
    (bit_pairs k))) (bit_pairs j))) (bit_pairs i)).
Definition positive_jacobian_test : bool :=
  forallb (fun i => forallb (fun j => forallb (fun k => Z.ltb 0 (zbernstein i j k))
    [I0; I1; I2]) [I0; I1; I2]) [I0; I1; I2].
End Integers.

Section Jacobian.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).

Section Expansion.
Variable p : vertex -> point K.

Definition edge_r (b c : bool) : point K := minus (p (vertex_at true b c)) (p (vertex_at false b c)).
Definition edge_s (a c : bool) : point K := minus (p (vertex_at a true c)) (p (vertex_at a false c)).
Definition edge_t (a b : bool) : point K := minus (p (vertex_at a b true)) (p (vertex_at a b false)).
Definition total (l : list K) : K := fold_right add 0 l.
Definition bernstein (i j k : index) : K :=
  total (map (fun a => total (map (fun b => total (map (fun c =>
    det3 (edge_r (fst b) (fst c)) (edge_s (fst a) (snd c)) (edge_t (snd a) (snd b)))
    (bit_pairs k))) (bit_pairs j))) (bit_pairs i)).

(** A linear combination of four vectors. *)
Definition sum4 (F : bool -> bool -> K) : K :=
  F false false + F false true + F true false + F true true.
Definition mix (f : bool -> bool -> K) (e : bool -> bool -> point K) : point K :=
  Point (sum4 (fun b c => f b c * px (e b c))) (sum4 (fun b c => f b c * py (e b c)))
    (sum4 (fun b c => f b c * pz (e b c))).
Lemma det3_mix_1 f e x y : det3 (mix f e) x y = sum4 (fun b c => f b c * det3 (e b c) x y).
Proof. unfold mix, sum4. coordinates. Qed.
Lemma det3_mix_2 f e x y : det3 x (mix f e) y = sum4 (fun b c => f b c * det3 x (e b c) y).
Proof. unfold mix, sum4. coordinates. Qed.
Lemma det3_mix_3 f e x y : det3 x y (mix f e) = sum4 (fun b c => f b c * det3 x y (e b c)).
Proof. unfold mix, sum4. coordinates. Qed.
Lemma sum4_ext F G : (forall b c, F b c = G b c) -> sum4 F = sum4 G.
Proof. intro h. unfold sum4. now rewrite !h. Qed.

(** The derivatives of Definitions.v are what they are called: the map is affine in each variable, so
    that a difference is the derivative times the step; and a corner is sent to its point. *)
Ltac expand_map :=
  unfold trilinear, weight, derivative_r, derivative_s, derivative_t, combination, minus, sum;
  cbn [corner factor slope px py pz]; f_equal; ring.
Definition scale (c : K) (a : point K) : point K := Point (c * px a) (c * py a) (c * pz a).
Lemma difference_r r r' s t :
  minus (trilinear p r' s t) (trilinear p r s t) = scale (r' - r) (derivative_r p r s t).
Proof. unfold scale. expand_map. Qed.
Lemma difference_s r s s' t :
  minus (trilinear p r s' t) (trilinear p r s t) = scale (s' - s) (derivative_s p r s t).
Proof. unfold scale. expand_map. Qed.
Lemma difference_t r s t t' :
  minus (trilinear p r s t') (trilinear p r s t) = scale (t' - t) (derivative_t p r s t).
Proof. unfold scale. expand_map. Qed.
Lemma corner_point v : let '(a, b, c) := corner v in
  let number (b : bool) := if b then 1 else 0 in
  trilinear p (number a) (number b) (number c) = p v.
Proof.
  destruct v; cbn [corner]; cbv zeta iota;
    match goal with |- _ = p ?v => destruct (p v) as [x y z] eqn:e end;
    unfold trilinear, weight, combination, sum; cbn [corner factor]; rewrite e; cbn [px py pz];
    f_equal; ring.
Qed.

Ltac expand_derivative :=
  unfold mix, sum4, combination, sum; cbn [corner vertex_at slope px py pz]; f_equal;
  unfold minus; cbn [px py pz]; ring.
Lemma derivative_r_mix r s t :
  derivative_r p r s t = mix (fun b c => factor b s * factor c t) edge_r.
Proof. unfold derivative_r, edge_r. expand_derivative. Qed.
Lemma derivative_s_mix r s t :
  derivative_s p r s t = mix (fun a c => factor a r * factor c t) edge_s.
Proof. unfold derivative_s, edge_s. expand_derivative. Qed.
Lemma derivative_t_mix r s t :
  derivative_t p r s t = mix (fun a b => factor a r * factor b s) edge_t.
Proof. unfold derivative_t, edge_t. expand_derivative. Qed.

Definition m (i : index) (t : K) : K :=
  match i with I0 => (1 - t) * (1 - t) | I1 => t * (1 - t) | I2 => t * t end.
Definition sum3 (F : index -> K) : K := F I0 + F I1 + F I2.

(** Collect the 64 products of an r-edge, an s-edge and a t-edge. *)
Lemma collect (d : bool -> bool -> bool -> bool -> bool -> bool -> K) r s t :
  sum4 (fun b c => factor b s * factor c t * sum4 (fun a' c' => factor a' r * factor c' t *
    sum4 (fun a'' b'' => factor a'' r * factor b'' s * d b c a' c' a'' b''))) =
  sum3 (fun i => m i r * sum3 (fun j => m j s * sum3 (fun k => m k t *
    total (map (fun a => total (map (fun b => total (map (fun c =>
      d (fst b) (fst c) (fst a) (snd c) (snd a) (snd b)) (bit_pairs k))) (bit_pairs j))) (bit_pairs i))))).
Proof.
  unfold sum3, sum4, total. cbn [bit_pairs map fold_right fst snd m].
  cbn [factor]. generalize (1 - r) (1 - s) (1 - t). intros r' s' t'. ring.
Qed.

Theorem jacobian_expansion r s t : jacobian p r s t =
  sum3 (fun i => m i r * sum3 (fun j => m j s * sum3 (fun k => m k t * bernstein i j k))).
Proof.
  unfold jacobian. rewrite derivative_r_mix, derivative_s_mix, derivative_t_mix, det3_mix_1.
  transitivity (sum4 (fun b c => factor b s * factor c t * sum4 (fun a' c' => factor a' r * factor c' t *
    sum4 (fun a'' b'' => factor a'' r * factor b'' s * det3 (edge_r b c) (edge_s a' c') (edge_t a'' b''))))).
  - apply sum4_ext. intros b c. f_equal. rewrite det3_mix_2. apply sum4_ext. intros a' c'. f_equal.
    apply det3_mix_3.
  - exact (collect (fun b c a' c' a'' b'' => det3 (edge_r b c) (edge_s a' c') (edge_t a'' b'')) r s t).
Qed.
End Expansion.

(** ** Positive coefficients *)

Lemma in_unit_zero : in_unit (0 : K).
Proof. split; [now right | left; apply zero_lt_one]. Qed.
Lemma in_unit_one : in_unit (1 : K).
Proof. split; [left; apply zero_lt_one | now right]. Qed.

Lemma mean_positive t F : in_unit t -> (forall i, 0 < F i) -> 0 < sum3 (fun i => m i t * F i).
Proof.
  intros [h0 h1] pos. apply le_sub in h1.
  assert (n0 : 0 <= m I0 t) by now apply nonneg_mul.
  assert (n1 : 0 <= m I1 t) by now apply nonneg_mul.
  assert (n2 : 0 <= m I2 t) by now apply nonneg_mul.
  assert (n : forall i, 0 <= m i t * F i).
  { intro i. apply nonneg_mul; [destruct i; auto | left; auto]. }
  unfold sum3. destruct h0 as [h0 | <-].
  - apply nonneg_pos_add; [now apply nonneg_add |]. apply lt_mul; auto. now apply lt_mul.
  - apply pos_nonneg_add; auto. apply pos_nonneg_add; auto.
    replace (m I0 0 * F I0) with (F I0); auto. simpl. ring.
Qed.
Lemma phi_total l : phi (ztotal l) = total (map (phi (K := K)) l).
Proof.
  induction l as [| x l IH]; simpl; [apply phi_0 |]. now rewrite phi_add, IH.
Qed.
Lemma bernstein_image (p : vertex -> zpoint) i j k :
  bernstein (imaged p) i j k = phi (zbernstein p i j k).
Proof.
  unfold bernstein, zbernstein. rewrite phi_total, map_map. f_equal. apply map_ext. intro a.
  rewrite phi_total, map_map. f_equal. apply map_ext. intro b.
  rewrite phi_total, map_map. f_equal. apply map_ext. intro c.
  unfold edge_r, edge_s, edge_t, zedge_r, zedge_s, zedge_t, imaged.
  now rewrite <- !image_minus, image_det3.
Qed.
Theorem positive_jacobian_test_sound (p : vertex -> zpoint) :
  positive_jacobian_test p = true -> positive_jacobian (imaged (K := K) p).
Proof.
  unfold positive_jacobian_test. rewrite forallb_forall. intros h r s t hr hs ht.
  rewrite jacobian_expansion. apply mean_positive; auto. intro i. apply mean_positive; auto. intro j.
  apply mean_positive; auto. intro k. rewrite bernstein_image. apply phi_pos, Z.ltb_lt.
  assert (all_indices : forall x, In x [I0; I1; I2]) by (intros []; simpl; tauto).
  specialize (h i (all_indices i)). rewrite forallb_forall in h.
  specialize (h j (all_indices j)). rewrite forallb_forall in h. exact (h k (all_indices k)).
Qed.

(** ** Corners: J is the determinant of a vertex and its neighbours, up to a sign *)

Section Clauses.
Variable p : vertex -> point K.
Hypothesis positive : positive_jacobian p.

Definition number (b : bool) : K := if b then 1 else 0.
Lemma in_unit_number b : in_unit (number b).
Proof. destruct b; [apply in_unit_one | apply in_unit_zero]. Qed.

Lemma jacobian_corner v :
  jacobian p (number (bit Axis_r v)) (number (bit Axis_s v)) (number (bit Axis_t v)) =
  signed (negb (xorb (bit Axis_r v) (xorb (bit Axis_s v) (bit Axis_t v))))
    (volume p (v, across Axis_r v, across Axis_s v, across Axis_t v)).
Proof.
  destruct v; cbv [bit corner across find flip negb same_corner eqb andb all_vertices xorb signed];
    unfold jacobian, derivative_r, derivative_s, derivative_t, volume;
    unfold combination, sum; cbn [corner factor slope number]; coordinates.
Qed.
Lemma corners_sound c : In c corners -> true_clause p true c.
Proof.
  unfold corners. rewrite in_map_iff. intros (v & <- & _). eexists. split; [now left |].
  unfold holds, has, D. cbn [signed]. rewrite <- (jacobian_corner v).
  apply positive; apply in_unit_number.
Qed.

(** ** Edges

    Along the edge from v to w, J is, up to a sign, a (1-t)^2 + (b+c) t (1-t) + d t^2, where a, b, c,
    d are the determinants of v, w, one of the two other neighbours of v or of w along the axis j,
    and one along k. Let this be positive on [0,1]; then a, d > 0. If b and c are negative, then at
    t / (1-t) = - (b+c) / 2d the value is a - (b+c)^2 / 4d up to a positive factor, so that
    4 a d > (b+c)^2 >= 4 b c. No square root is needed. *)

Lemma quadratic (a b c d : K) :
  (forall t, in_unit t -> 0 < a * ((1 - t) * (1 - t)) + (b + c) * (t * (1 - t)) + d * (t * t)) ->
  0 < - b -> 0 < - c -> 0 < a * d - b * c.
Proof.
  intros h hb hc.
  assert (hd : 0 < d).
  { pose proof (h 1 in_unit_one) as h1.
    now replace (a * ((1 - 1) * (1 - 1)) + (b + c) * (1 * (1 - 1)) + d * (1 * 1)) with d in h1 by ring. }
  set (e := - b - c).
  assert (he : 0 < e) by now apply pos_add.
  set (n := d + d + e).
  assert (hn : 0 < n) by (repeat apply pos_add; auto).
  assert (inverse : n * inv n = 1) by now apply mul_inv, pos_neq_zero.
  set (t := e * inv n).
  assert (hi : 0 < inv n) by now apply inv_pos.
  assert (hu : 1 - t = (d + d) * inv n).
  { unfold t. rewrite <- inverse. unfold n. ring. }
  assert (ht : in_unit t).
  { split; [left; now apply lt_mul |]. apply le_sub. rewrite hu. left. apply lt_mul; auto.
    now apply pos_add. }
  specialize (h t ht). rewrite hu in h. unfold t in h.
  assert (h4 : 0 < (a * d + a * d + a * d + a * d) - e * e).
  { apply (pos_cancel K (d * (inv n * inv n))).
    - repeat apply lt_mul; auto.
    - match type of h with 0 < ?x => replace (d * (inv n * inv n) * _) with x; [exact h |] end.
      replace (b + c) with (- e) by (unfold e; ring). ring. }
  assert (h0 : 0 <= e * e - (b * c + b * c + b * c + b * c)).
  { replace (e * e - (b * c + b * c + b * c + b * c)) with ((b - c) * (b - c)) by (unfold e; ring).
    apply square_nonneg. }
  apply (pos_cancel K (1 + 1 + 1 + 1)).
  - repeat apply pos_add; apply zero_lt_one.
  - replace ((1 + 1 + 1 + 1) * (a * d - b * c)) with
      ((a * d + a * d + a * d + a * d - e * e) + (e * e - (b * c + b * c + b * c + b * c))) by ring.
    now apply pos_nonneg_add.
Qed.

(** The point of the unit cube at the place t on the edge from v along the axis i. *)
Definition place_on (i : axis) (v : vertex) (t : K) (x : axis) : K :=
  match i, x with
  | Axis_r, Axis_r | Axis_s, Axis_s | Axis_t, Axis_t => t
  | _, _ => number (bit x v)
  end.
Lemma jacobian_edge i j k v t :
  In (i, j, k) [(Axis_r, Axis_s, Axis_t); (Axis_s, Axis_t, Axis_r); (Axis_t, Axis_r, Axis_s)] ->
  bit i v = false ->
  let w := across i v in
  let V q r := volume p (v, w, q, r) in
  jacobian p (place_on i v t Axis_r) (place_on i v t Axis_s) (place_on i v t Axis_t) =
  signed (negb (xorb (bit j v) (bit k v)))
    (V (across j v) (across k v) * ((1 - t) * (1 - t)) +
     (V (across j v) (across k w) + V (across j w) (across k v)) * (t * (1 - t)) +
     V (across j w) (across k w) * (t * t)).
Proof.
  intros [e | [e | [e | []]]]; injection e as <- <- <-; destruct v; intro h; try discriminate h; clear h;
    cbv [bit corner across find flip negb same_corner eqb andb all_vertices xorb signed place_on];
    unfold jacobian, derivative_r, derivative_s, derivative_t, volume;
    unfold combination, sum; cbn [corner factor slope number]; coordinates.
Qed.
Lemma edges_sound c : In c edges -> true_clause p true c.
Proof.
  unfold edges. rewrite in_flat_map. intros ([[i j] k] & iijk & h). apply in_flat_map in h.
  destruct h as (v & _ & h). destruct (bit i v) eqn:start; [destruct h |].
  pose proof (fun t => jacobian_edge i j k v t iijk start) as expansion. cbv zeta in expansion.
  set (w := across i v) in *. set (sign := negb (xorb (bit j v) (bit k v))) in *.
  unfold edge in h. fold sign in h. cbv zeta in h. apply in_map_iff in h as (e & <- & _).
  apply by_contradiction. intro fail.
  pose proof (fail _ (or_introl eq_refl)) as hb. pose proof (fail _ (or_intror (or_introl eq_refl))) as hc.
  pose proof (fail _ (or_intror (or_intror (or_introl eq_refl)))) as hP.
  pose proof (fail _ (or_intror (or_intror (or_intror (or_introl eq_refl))))) as hQ.
  cbn [fails] in hb, hc, hP, hQ. unfold has, D in hb, hc, hP, hQ.
  cbn [Signs.signed] in hb, hc, hP, hQ.
  set (b := volume p (v, w, across j v, across k w)) in *.
  set (c := volume p (v, w, across j w, across k v)) in *.
  set (P := volume p (v, w, across j v, across j w)) in *.
  set (Q := volume p (v, w, across k v, across k w)) in *.
  set (a := volume p (v, w, across j v, across k v)) in *.
  set (d := volume p (v, w, across j w, across k w)) in *.
  assert (pos : 0 < signed sign a * signed sign d - signed sign b * signed sign c).
  { apply quadratic.
    - intros t ht.
      assert (u : forall x, in_unit (place_on i v t x)).
      { intros x. unfold place_on. destruct i, x; auto using in_unit_number. }
      pose proof (positive _ _ _ (u Axis_r) (u Axis_s) (u Axis_t)) as h. rewrite expansion in h.
      replace (signed sign a * _ + _ + _) with (signed sign (a * ((1 - t) * (1 - t)) + (b + c) * (t * (1 - t)) + d * (t * t)));
        [exact h | destruct sign; simpl; ring].
    - rewrite <- signed_negb. exact hb.
    - rewrite <- signed_negb. exact hc. }
  assert (gp : signed sign a * signed sign d - signed sign b * signed sign c = P * Q).
  { transitivity (a * d - b * c); [destruct sign; simpl; ring |].
    unfold a, b, c, d, P, Q, volume. coordinates. }
  rewrite gp in pos.
  apply not_pos in hP, hQ. apply (not_pos K (P * Q)); auto.
  destruct e; simpl in hP, hQ.
  - replace (- (P * Q)) with (- P * - - Q) by ring. now apply nonneg_mul.
  - replace (- (P * Q)) with (- - P * - Q) by ring. now apply nonneg_mul.
Qed.
End Clauses.
End Jacobian.
