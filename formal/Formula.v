(** * The formula of a pattern

    The clauses that the signs of all determinants satisfy wherever eight points realize a pattern:
    the families of section 4 of FORMAT.md as Coq functions, in the same order, so that the proofs
    refer to the right clauses by their numbers. Why the clauses hold is the subject of other files
    (Signs.v, Convex.v, Jacobian.v, Polynomials.v, Separation.v): every clause that a function here
    gives is proved true there. That none is missing that a proof uses, the replay shows.

    A literal speaks of four vertices in any order. Exchanging two of them changes the sign of the
    determinant, so that signs of coefficients can be expressed by the order: where a formula has
    - det(a, c, d, e), we write det(c, a, d, e). Sorting is left to the translation of literals to
    numbers at the end of this file. *)

From Coq Require Import List Bool ZArith FMapPositive.
From Certify Require Import Definitions Barycentric Integral Lrat.
Import ListNotations.

(** [Is q s]: det q has the sign s, where s is true for > 0 and false for < 0; [Not q s]: it has
    not. *)
Inductive literal : Type := Is (q : tetrahedron) (s : bool) | Not (q : tetrahedron) (s : bool).

Definition plus_minus : list bool := [true; false].

Definition quadruples : list tetrahedron :=
  flat_map (fun l => match l with [a; b; c; d] => [(a, b, c, d)] | _ => [] end)
    (choices 4 all_vertices).

(** Sorting: the vertices in increasing order, and whether the sign stays. *)

Definition rank (v : vertex) : nat :=
  match v with V1 => 1 | V2 => 2 | V3 => 3 | V4 => 4 | V5 => 5 | V6 => 6 | V7 => 7 | V8 => 8 end.
Definition exchange (v w : vertex) : bool := Nat.ltb (rank w) (rank v).
Definition sorted (q : tetrahedron) : tetrahedron * bool :=
  let '(a, b, c, d) := q in
  let '(a, b, s) := if exchange a b then (b, a, false) else (a, b, true) in
  let '(c, d, s) := if exchange c d then (d, c, negb s) else (c, d, s) in
  let '(a, c, s) := if exchange a c then (c, a, negb s) else (a, c, s) in
  let '(b, d, s) := if exchange b d then (d, b, negb s) else (b, d, s) in
  let '(b, c, s) := if exchange b c then (c, b, negb s) else (b, c, s) in
  ((a, b, c, d), s).

(** ** Exclusive: no determinant is positive and negative *)

Definition exclusive : list (list literal) := map (fun q => [Not q true; Not q false]) quadruples.

(** ** Grassmann-Pluecker

    For six points, [stab][stcd] + [tsac][stbd] + [stad][stbc] = 0. If one term has a sign, another
    has not the opposite of it. *)

Definition term : Type := tetrahedron * tetrahedron.
Definition terms (s t a b c d : vertex) : list (term * term * term) :=
  let x := ((s, t, a, b), (s, t, c, d)) in
  let y := ((t, s, a, c), (s, t, b, d)) in
  let z := ((s, t, a, d), (s, t, b, c)) in
  [(x, y, z); (y, x, z); (z, x, y)].

(** What, if false, gives the product the sign s, or lets it lack the sign opposite to s. *)
Definition strict (s : bool) (x : term) (f : bool) : list literal :=
  [Not (fst x) (eqb f s); Not (snd x) f].
Definition weak (s : bool) (x : term) (f : bool) : list literal :=
  [Is (fst x) (negb (eqb f s)); Is (snd x) (negb f)].

Definition relation (s t a b c d : vertex) : list (list literal) :=
  flat_map (fun sign => flat_map (fun xyz => let '(x, y, z) := xyz in
    flat_map (fun f => flat_map (fun g => map (fun h =>
      strict sign x f ++ weak sign y g ++ weak sign z h)
    plus_minus) plus_minus) plus_minus) (terms s t a b c d)) plus_minus.
Definition without (l : list vertex) : list vertex := filter (fun v => negb (mem v l)) all_vertices.
Definition grassmann_pluecker : list (list literal) :=
  flat_map (fun st => match st with
    | [s; t] => flat_map (fun l => match l with
        | [a; b; c; d] => relation s t a b c d
        | _ => [] end) (choices 4 (without st))
    | _ => [] end) (choices 2 all_vertices).

(** ** Oriented: every tetrahedron has its sign

    A tetrahedron is oriented if its vertices are listed so that the determinant is positive. *)

(** The triangle opposite to a vertex of an oriented tetrahedron, as it is seen from beyond: with
    the vertex of a neighbour appended, it is an oriented tetrahedron again. *)
Definition beyond (q : tetrahedron) (v : vertex) : vertex * vertex * vertex :=
  let '(a, b, c, d) := q in
  if same_vertex v a then (d, b, c)
  else if same_vertex v b then (c, a, d)
  else if same_vertex v c then (d, a, b)
  else (b, a, c).

Definition is_cell (T : list tetrahedron) (q : tetrahedron) : bool :=
  existsb (fun t => forallb (fun v => mem v (vertices t)) (vertices q)) T.

(** The twelve boundary triangles: of the triangles of the facets, those that belong to exactly one
    tetrahedron. *)
Definition boundary (T : list tetrahedron) : list (vertex * vertex * vertex) :=
  filter (fun f => let '(a, b, c) := f in
    Nat.eqb 1 (length (filter (fun t => forallb (fun v => mem v (vertices t)) [a; b; c]) T)))
    (flat_map (fun f => let '(a, b, c, d) := f in [(a, b, c); (c, d, a); (d, a, b); (b, c, d)]) facets).

(** Visit the tetrahedra of T: take the triangle on top of a stack, visit what contains it and was
    not visited, and push its four triangles. *)
Fixpoint visit (fuel : nat) (T : list tetrahedron) (stack : list (vertex * vertex * vertex))
    : list tetrahedron :=
  match fuel, stack with
  | S fuel', (a, b, c) :: stack' =>
      match find (fun t => forallb (fun v => mem v (vertices t)) [a; b; c]) T with
      | Some t =>
          match filter (fun v => negb (mem v [a; b; c])) (vertices t) with
          | [d] =>
              let q := (a, b, c, d) in
              let rest := filter (fun u =>
                negb (forallb (fun v => mem v (vertices u)) (vertices t))) T in
              q :: visit fuel' rest (rev (map (beyond q) (vertices t)) ++ stack')
          | _ => []
          end
      | None => visit fuel' T stack'
      end
  | _, _ => []
  end.

(** [q] is oriented if [r] is: they lie on different sides of a triangle. *)
Definition opposite (q r : tetrahedron) : bool :=
  let '(a, b, c, d) := q in
  negb (mem d (vertices r)) &&
  existsb (fun v => let '(x, y, z) := beyond r v in
    same_vertex a x && same_vertex b y && same_vertex c z) (vertices r).

(** The tetrahedra as visited, and oriented, if the first of them is. *)
Fixpoint coherent (T : list tetrahedron) (known order : list tetrahedron) : list tetrahedron :=
  match order with
  | [] => []
  | q :: order' =>
      if is_cell T q && existsb (opposite q) known
      then q :: coherent T (q :: known) order'
      else coherent T known order'
  end.
Definition orientation (T : list tetrahedron) : list tetrahedron :=
  match visit 100 T (rev (boundary T)) with
  | [] => []
  | first :: order =>
      if existsb (same_tetrahedron (fst (sorted first))) T && is_cell T first
      then first :: coherent T [first] order else []
  end.
Definition oriented (T : list tetrahedron) : list (list literal) :=
  map (fun q => [Is q true]) (orientation T).

(** ** No overlap

    The dependence of five points: the coefficient of a vertex is the determinant of the others, in
    an order that accounts for the sign. *)

Definition quintuple : Type := vertex * vertex * vertex * vertex * vertex.
Definition members (q : quintuple) : list vertex := let '(a, b, c, d, e) := q in [a; b; c; d; e].
Definition coefficients (q : quintuple) : list (vertex * tetrahedron) :=
  let '(a, b, c, d, e) := q in
  [(a, (b, c, d, e)); (b, (c, a, d, e)); (c, (a, b, d, e)); (d, (b, a, c, e)); (e, (a, b, c, d))].
Definition quintuples : list quintuple :=
  flat_map (fun l => match l with [a; b; c; d; e] => [(a, b, c, d, e)] | _ => [] end)
    (choices 5 all_vertices).

Fixpoint sublists (l : list vertex) : list (list vertex) :=
  match l with [] => [[]] | x :: l' => let s := sublists l' in [] :: map (cons x) s ++ tl s end.
Definition included (f g : list vertex) : bool := forallb (fun v => mem v g) f.

(** The faces of T with vertices in the quintuple that are maximal. *)
Definition traces (T : list tetrahedron) (q : quintuple) : list (list vertex) :=
  let faces := filter (fun f => existsb (fun t => included f (vertices t)) T) (sublists (members q)) in
  filter (fun f => negb (existsb (fun g => included f g && negb (included g f)) faces)) faces.

(** If a coefficient on f is positive, or one on g negative, then one outside f is positive or one
    outside g negative. *)
Definition on (q : quintuple) (f : list vertex) : list tetrahedron :=
  map snd (filter (fun c => mem (fst c) f) (coefficients q)).
Definition off (q : quintuple) (f : list vertex) : list tetrahedron :=
  map snd (filter (fun c => negb (mem (fst c) f)) (coefficients q)).
Definition overlap (q : quintuple) (f g : list vertex) : list (list literal) :=
  let escape := map (fun x => Is x true) (off q f) ++ map (fun x => Is x false) (off q g) in
  map (fun x => Not x true :: escape) (on q f) ++ map (fun x => Not x false :: escape) (on q g).
Definition no_overlaps (T : list tetrahedron) : list (list literal) :=
  flat_map (fun q => let faces := traces T q in
    flat_map (fun f => flat_map (fun g =>
      if forallb (fun v => mem v f || mem v g) (members q) then overlap q f g else [])
    faces) faces) quintuples.

(** ** On hull: no vertex is inside a tetrahedron of four others *)

Definition on_hulls : list (list literal) :=
  flat_map (fun q => flat_map (fun inner => map (fun s =>
    map (fun c => Not (snd c) (if same_vertex (fst c) inner then s else negb s)) (coefficients q))
    plus_minus) (members q)) quintuples.

(** ** Corners and edges: where the Jacobian is positive *)

Inductive axis : Type := Axis_r | Axis_s | Axis_t.
Definition flip (i : axis) (c : bool * bool * bool) : bool * bool * bool :=
  let '(x, y, z) := c in
  match i with
  | Axis_r => (negb x, y, z) | Axis_s => (x, negb y, z) | Axis_t => (x, y, negb z)
  end.
Definition same_corner (c d : bool * bool * bool) : bool :=
  let '(x, y, z) := c in let '(x', y', z') := d in eqb x x' && eqb y y' && eqb z z'.
(** The vertex across along an axis. *)
Definition across (i : axis) (v : vertex) : vertex :=
  match find (fun w => same_corner (corner w) (flip i (corner v))) all_vertices with
  | Some w => w
  | None => v
  end.
Definition bit (i : axis) (v : vertex) : bool :=
  let '(x, y, z) := corner v in match i with Axis_r => x | Axis_s => y | Axis_t => z end.

(** The sign of a product of axes that point forward or back. *)
Definition corners : list (list literal) :=
  map (fun v => [Is (v, across Axis_r v, across Axis_s v, across Axis_t v)
    (negb (xorb (bit Axis_r v) (xorb (bit Axis_s v) (bit Axis_t v))))]) all_vertices.

Definition edge (j k : axis) (v w : vertex) : list (list literal) :=
  let sign := negb (xorb (bit j v) (bit k v)) in
  map (fun e =>
    [Not (v, w, across j v, across k w) (negb sign); Not (v, w, across j w, across k v) (negb sign);
     Is (v, w, across j v, across j w) e; Is (v, w, across k v, across k w) (negb e)]) plus_minus.
Definition edges : list (list literal) :=
  flat_map (fun ijk => let '(i, j, k) := ijk in
    flat_map (fun v => if bit i v then [] else edge j k v (across i v)) all_vertices)
  [(Axis_r, Axis_s, Axis_t); (Axis_s, Axis_t, Axis_r); (Axis_t, Axis_r, Axis_s)].

(** ** Separations

    Let A and B be opposite facets. If J is positive and det A and det B have opposite signs, then a
    plane separates A from B (Separation.v), and no circuit has one side in A and the other in B. *)

Definition facet_across (i j k : axis) (side : bool) : tetrahedron :=
  let v := if side then across i V1 else V1 in
  (v, across j v, across k v, across k (across j v)).
Definition separations : list (list literal) :=
  flat_map (fun ijk => let '(i, j, k) := ijk in
    let A := facet_across i j k false in
    let B := facet_across i j k true in
    flat_map (fun s => flat_map (fun q =>
      let f := filter (fun v => mem v (vertices A)) (members q) in
      let g := filter (fun v => mem v (vertices B)) (members q) in
      map (fun c => Not A s :: Not B (negb s) :: c) (overlap q f g ++ overlap q g f))
    quintuples) plus_minus)
  [(Axis_r, Axis_s, Axis_t); (Axis_s, Axis_t, Axis_r); (Axis_t, Axis_r, Axis_s)].

(** ** From literals to numbers

    The k-th quadruple has the variables 2k - 1 (positive) and 2k (negative). *)

(** What a variable says: [table]. The variable that says it: [numbers], found by a key, and
    compared with the table. *)
Definition atom : Type := tetrahedron * bool.
Definition atoms : list atom := flat_map (fun q => [(q, true); (q, false)]) quadruples.
Definition bits (v : vertex) : positive -> positive :=
  match v with
  | V1 => fun n => n~0~0~0 | V2 => fun n => n~0~0~1 | V3 => fun n => n~0~1~0 | V4 => fun n => n~0~1~1
  | V5 => fun n => n~1~0~0 | V6 => fun n => n~1~0~1 | V7 => fun n => n~1~1~0 | V8 => fun n => n~1~1~1
  end%positive.
Definition key (x : atom) : positive :=
  let '(a, b, c, d, s) := x in bits a (bits b (bits c (bits d (if s then 3 else 2)%positive))).
Fixpoint enumerate {A} (n : positive) (l : list atom) (add : atom -> positive -> P.t A -> P.t A)
    (m : P.t A) : P.t A :=
  match l with [] => m | x :: l' => enumerate (Pos.succ n) l' add (add x n m) end.
Definition table : P.t atom :=
  Eval vm_compute in enumerate 1 atoms (fun x n => P.add n x) (P.empty atom).
Definition numbers : P.t positive :=
  Eval vm_compute in enumerate 1 atoms (fun x n => P.add (key x) n) (P.empty positive).

Definition same_atom (x y : atom) : bool :=
  same_tetrahedron (fst x) (fst y) && eqb (snd x) (snd y).
Definition variable (x : atom) : option positive :=
  match P.find (key x) numbers with
  | Some n => match P.find n table with Some y => if same_atom x y then Some n else None | None => None end
  | None => None
  end.
Definition atom_of (q : tetrahedron) (s : bool) : atom := let '(r, e) := sorted q in (r, eqb s e).
Definition encode_literal (l : literal) : option Z :=
  match l with
  | Is q s => option_map Zpos (variable (atom_of q s))
  | Not q s => option_map Zneg (variable (atom_of q s))
  end.
Fixpoint encode (c : list literal) : option clause :=
  match c with
  | [] => Some []
  | l :: c' =>
      match encode_literal l, encode c' with Some n, Some d => Some (n :: d) | _, _ => None end
  end.
(** A clause that cannot be translated, which never happens, would be left out. *)
Fixpoint encode_all (cs : list (list literal)) : list clause :=
  match cs with
  | [] => []
  | c :: cs' => match encode c with Some d => d :: encode_all cs' | None => encode_all cs' end
  end.

(** The clauses that do not depend on the pattern are loaded once for all patterns. *)
Definition axioms : list clause := encode_all (exclusive ++ grassmann_pluecker).
Definition axioms_loaded : P.t clause := load 1 axioms (P.empty clause).
Definition next : positive := Eval vm_compute in Pos.of_succ_nat (length axioms).

Definition refuted_with (extra : list (list literal)) (db : P.t clause) (T : list tetrahedron)
    (proof : list step) : bool :=
  replay (load next (encode_all (oriented T ++ no_overlaps T ++ extra)) db) proof.
