(** * What is claimed, in words of geometry

    Nothing is proved in this file. Whoever believes Coq, and finds here what he or she calls a
    realization, a convex position and a valid hexahedron, can believe the statements in Theorems.v
    without reading a proof. Besides, one reads what an ordered field is (in Field.v), and what a
    pattern says (Pattern.v). *)

From Coq Require Import List Permutation.
From Certify Require Export Field.
Import ListNotations.

(** ** The eight vertices and the cube they come from *)

Inductive vertex : Type := V1 | V2 | V3 | V4 | V5 | V6 | V7 | V8.

(** Four vertices. *)
Definition tetrahedron : Type := vertex * vertex * vertex * vertex.
Definition vertices (t : tetrahedron) : list vertex := let '(a, b, c, d) := t in [a; b; c; d].

(** The corner of the unit cube that a vertex is: is its coordinate 1 (true) or 0 (false)? *)
Definition corner (v : vertex) : bool * bool * bool :=
  match v with
  | V1 => (false, false, false)
  | V2 => (true, false, false)
  | V3 => (true, true, false)
  | V4 => (false, true, false)
  | V5 => (false, false, true)
  | V6 => (true, false, true)
  | V7 => (true, true, true)
  | V8 => (false, true, true)
  end.

(** The six facets, each counterclockwise as seen from inside the cube. *)
Definition facets : list (vertex * vertex * vertex * vertex) :=
  [(V1, V2, V3, V4); (V1, V5, V6, V2); (V1, V4, V8, V5);
   (V2, V6, V7, V3); (V3, V7, V8, V4); (V5, V8, V7, V6)].

(** Any three vertices of a facet, in the same sense: what a diagonal can cut off. *)
Definition facet_triangles : list (vertex * vertex * vertex) :=
  flat_map (fun f => let '(a, b, c, d) := f in [(a, b, c); (b, c, d); (c, d, a); (d, a, b)]) facets.

Section Geometry.
Variable K : ordered_field.
Local Open Scope K_scope.

(** ** Points, determinants, convex hulls *)

Record point : Type := Point { px : K; py : K; pz : K }.
Definition origin : point := Point 0 0 0.
Definition minus (a b : point) : point := Point (px a - px b) (py a - py b) (pz a - pz b).
Definition dot (a b : point) : K := px a * px b + py a * py b + pz a * pz b.

(** The determinant of three vectors, and that of four points. *)
Definition det3 (a b c : point) : K :=
  px a * (py b * pz c - pz b * py c) - py a * (px b * pz c - pz b * px c) + pz a * (px b * py c - py b * px c).
Definition det (a b c d : point) : K := det3 (minus b a) (minus c a) (minus d a).

Definition sum (f : vertex -> K) : K := f V1 + f V2 + f V3 + f V4 + f V5 + f V6 + f V7 + f V8.

(** A placement [p] of the eight vertices is any map to points. *)
Definition combination (w : vertex -> K) (p : vertex -> point) : point :=
  Point (sum (fun v => w v * px (p v))) (sum (fun v => w v * py (p v))) (sum (fun v => w v * pz (p v))).

(** [x] lies in the convex hull of the points of some of the vertices. *)
Definition hull (p : vertex -> point) (some : vertex -> Prop) (x : point) : Prop :=
  exists w : vertex -> K,
    (forall v, 0 <= w v) /\ (forall v, ~ some v -> w v = 0) /\ sum w = 1 /\ combination w p = x.

Definition volume (p : vertex -> point) (t : tetrahedron) : K :=
  let '(a, b, c, d) := t in det (p a) (p b) (p c) (p d).

(** ** Realizations

    The tetrahedra are not degenerate, and any two of them meet only in the hull of the vertices
    that they have in common. (The other inclusion is clear.) Nothing else is assumed: the points
    may coincide, or be coplanar; that the tetrahedra are coherently oriented is not demanded,
    since it follows. *)
Record realizes (T : list tetrahedron) (p : vertex -> point) : Prop := Realizes {
  not_degenerate : forall t, In t T -> volume p t <> 0;
  meet_properly : forall s t, In s T -> In t T -> forall x,
    hull p (fun v => In v (vertices s)) x -> hull p (fun v => In v (vertices t)) x ->
    hull p (fun v => In v (vertices s) /\ In v (vertices t)) x
}.

(** ** Convex position

    A vertex is extreme if its point is not in the hull of the seven others. *)
Definition extreme (p : vertex -> point) (v : vertex) : Prop := ~ hull p (fun u => u <> v) (p v).
Definition convex_position (p : vertex -> point) : Prop := forall v, extreme p v.

(** It lies on the boundary of the hull if there is a plane through it, with normal [n], that has
    all eight points on one side or in it. *)
Definition on_hull (p : vertex -> point) (v : vertex) : Prop :=
  exists n, n <> origin /\ forall u, dot n (p v) <= dot n (p u).

(** It lies inside the hull, in the strongest sense, if it is a combination with four positive
    weights of the vertices of a tetrahedron that is not degenerate. Such a vertex is neither
    extreme nor on the boundary of the hull (Convex.v). *)
Definition inside (p : vertex -> point) (v : vertex) : Prop :=
  exists t w, volume p t <> 0 /\
    (forall u, In u (vertices t) -> 0 < w u) /\ (forall u, ~ In u (vertices t) -> w u = 0) /\
    sum w = 1 /\ combination w p = p v.

(** ** Valid hexahedra

    The trilinear map sends (r, s, t) in the unit cube to the combination of the eight points with
    the weights [weight v r s t]; a vertex's own corner is sent to its point. Its three partial
    derivatives are combinations too. *)
Definition factor (b : bool) (t : K) : K := if b then t else 1 - t.
Definition slope (b : bool) : K := if b then 1 else - (1). (* the derivative of [factor b] *)

Definition weight (v : vertex) (r s t : K) : K :=
  let '(a, b, c) := corner v in factor a r * factor b s * factor c t.
Definition trilinear (p : vertex -> point) (r s t : K) : point :=
  combination (fun v => weight v r s t) p.

Definition derivative_r (p : vertex -> point) (r s t : K) : point :=
  combination (fun v => let '(a, b, c) := corner v in slope a * factor b s * factor c t) p.
Definition derivative_s (p : vertex -> point) (r s t : K) : point :=
  combination (fun v => let '(a, b, c) := corner v in factor a r * slope b * factor c t) p.
Definition derivative_t (p : vertex -> point) (r s t : K) : point :=
  combination (fun v => let '(a, b, c) := corner v in factor a r * factor b s * slope c) p.
Definition jacobian (p : vertex -> point) (r s t : K) : K :=
  det3 (derivative_r p r s t) (derivative_s p r s t) (derivative_t p r s t).

Definition in_unit (t : K) : Prop := 0 <= t /\ t <= 1.
Definition positive_jacobian (p : vertex -> point) : Prop :=
  forall r s t, in_unit r -> in_unit s -> in_unit t -> 0 < jacobian p r s t.

(** A realization is not mirrored if every tetrahedron at a boundary triangle lies on the side of it
    on which it lies in the cube. A boundary triangle is a triangle of a facet that belongs to one
    tetrahedron only. *)
Definition not_mirrored (T : list tetrahedron) (p : vertex -> point) : Prop :=
  forall t a b c d, In t T -> In (a, b, c) facet_triangles -> Permutation [a; b; c; d] (vertices t) ->
    (forall u, In u T -> incl [a; b; c] (vertices u) -> Permutation (vertices u) (vertices t)) ->
    0 < det (p a) (p b) (p c) (p d).

(** For some patterns one more property of K is assumed: that a cubic polynomial takes the value 0
    between two places at which it has opposite signs. The real numbers have it, and so has every
    real closed field; the rational numbers have not. *)
Definition cubic_intermediate_values : Prop :=
  forall a b c d : K, let f t := ((a * t + b) * t + c) * t + d in
    f 0 < 0 -> 0 < f 1 -> exists t, 0 < t /\ t < 1 /\ f t = 0.

Record valid (T : list tetrahedron) (p : vertex -> point) : Prop := Valid {
  valid_realizes : realizes T p;
  valid_not_mirrored : not_mirrored T p;
  valid_jacobian : positive_jacobian p
}.
End Geometry.

Arguments Point {K}.
Arguments px {K}.
Arguments py {K}.
Arguments pz {K}.
Arguments origin {K}.
Arguments minus {K}.
Arguments dot {K}.
Arguments det3 {K}.
Arguments det {K}.
Arguments sum {K}.
Arguments combination {K}.
Arguments hull {K}.
Arguments volume {K}.
Arguments realizes {K}.
Arguments not_degenerate {K}.
Arguments meet_properly {K}.
Arguments extreme {K}.
Arguments convex_position {K}.
Arguments on_hull {K}.
Arguments inside {K}.
Arguments factor {K}.
Arguments slope {K}.
Arguments weight {K}.
Arguments trilinear {K}.
Arguments derivative_r {K}.
Arguments derivative_s {K}.
Arguments derivative_t {K}.
Arguments jacobian {K}.
Arguments in_unit {K}.
Arguments positive_jacobian {K}.
Arguments not_mirrored {K}.
Arguments valid {K}.
