(** * What is claimed, in words of combinatorial topology

    Nothing is proved in this file. It says what a triangulation of the hexahedron is, and when two
    are the same up to the cube's symmetries. No point has coordinates here. *)

From Coq Require Import List Permutation.
From Certify Require Export Definitions.
Import ListNotations.

(** A set of tetrahedra is given by a list; neither the order in the list, nor repetitions, nor the
    order in which a tetrahedron names its vertices matter, since every definition below speaks of
    [spans] only: a, b, c and d are, in some order, the vertices of one of them. *)
Definition spans (T : list tetrahedron) (a b c d : vertex) : Prop :=
  exists t, In t T /\ Permutation [a; b; c; d] (vertices t).

(** The tetrahedra at the triangle abc are those with a fourth vertex in [ds]. *)
Definition apexes (T : list tetrahedron) (a b c : vertex) (ds : list vertex) : Prop :=
  NoDup ds /\ forall d, In d ds <-> spans T a b c d.

(** The triangle abc is in the boundary: it lies in exactly one tetrahedron. *)
Definition in_boundary (T : list tetrahedron) (a b c : vertex) : Prop :=
  exists d, apexes T a b c [d].

(** ** The boundary of the hexahedron

    Each of the six facets is cut in two by one of its diagonals: 64 possibilities. *)
Definition triangle : Type := vertex * vertex * vertex.
Definition corners (t : triangle) : list vertex := let '(a, b, c) := t in [a; b; c].

Definition cuts (facet : tetrahedron) : list (list triangle) :=
  let '(a, b, c, d) := facet in [[(a, b, c); (a, c, d)]; [(a, b, d); (b, c, d)]].
Fixpoint choose_cuts (some : list tetrahedron) : list (list triangle) :=
  match some with
  | [] => [[]]
  | f :: others => flat_map (fun two => map (app two) (choose_cuts others)) (cuts f)
  end.
Definition boundaries : list (list triangle) := choose_cuts facets.

(** A list of triangles, too, stands for a set: abc is, in some order, one of them. *)
Definition face (D : list triangle) (a b c : vertex) : Prop :=
  exists t, In t D /\ Permutation [a; b; c] (corners t).

(** ** Links

    The link of an edge ab is a graph: x and y are joined if abxy is a tetrahedron. The link of a
    vertex v is a surface: abc is one of its triangles if vabc is a tetrahedron.

    A graph is one path, or one cycle. (A path may be empty: then no tetrahedron has the edge.) *)
Definition consecutive (l : list vertex) (x y : vertex) : Prop :=
  exists before after, l = before ++ x :: y :: after.
Definition neighbours (l : list vertex) (x y : vertex) : Prop :=
  consecutive l x y \/ consecutive l y x.

Definition path (joined : vertex -> vertex -> Prop) : Prop :=
  exists l, NoDup l /\ forall x y, joined x y <-> neighbours l x y.
Definition cycle (joined : vertex -> vertex -> Prop) : Prop :=
  exists v l, NoDup (v :: l) /\ 2 <= length l /\
    forall x y, joined x y <-> neighbours (v :: l ++ [v]) x y.

(** Discs. A triangle is a disc. A disc remains one if a triangle is glued to it along one edge of
    its rim, with a third vertex that is new, or along two consecutive edges of its rim, with a
    third edge that is new. This restricts nothing: every triangulated disc is made in this way.
    (Let t be a triangle at the rim of a disc that has others. Then one of the others can be taken
    off: let u be another one with an edge in the rim. If it cannot be taken off, then the vertex
    opposite to that edge is in the rim too, and u cuts the disc in two. The part without t is
    one triangle, which can be taken off; or go on in this part, with the triangle next to u in
    the place of t.) *)
Definition edge (D : list triangle) (a b : vertex) : Prop := exists c, face D a b c.
Definition has_vertex (D : list triangle) (a : vertex) : Prop := exists b, edge D a b.
Definition rim (D : list triangle) (a b : vertex) : Prop := exists! c, face D a b c.

Inductive disc : list triangle -> Prop :=
| one_triangle a b c : NoDup [a; b; c] -> disc [(a, b, c)]
| glue_one_edge D a b c : disc D -> rim D a b -> ~ has_vertex D c -> disc ((a, b, c) :: D)
| glue_two_edges D a b c :
    disc D -> rim D a b -> rim D b c -> a <> c -> ~ edge D a c -> disc ((a, b, c) :: D).

(** ** Triangulations

    [T] triangulates the hexahedron, and [B] is how its facets are cut. In one phrase: [T] is a
    3-manifold with boundary on the eight vertices, and its boundary is [B]. Some of the conditions
    follow from others, and are there for the reader's sake. That [T] is connected follows too (its
    vertices are all in [B], and the link of each is connected). That it is a ball is not demanded,
    so that the theorem says more: there is no other such manifold. *)
Record bounded_by (B : list triangle) (T : list tetrahedron) : Prop := BoundedBy {
  (** The tetrahedra have four different vertices, which are not those of a facet. *)
  proper : forall t, In t T -> NoDup (vertices t) /\
    forall f, In f facets -> ~ Permutation (vertices t) (vertices f);
  (** A triangle lies in at most two tetrahedra. *)
  at_most_two : forall a b c, NoDup [a; b; c] -> exists ds, apexes T a b c ds /\ length ds <= 2;
  (** Those that lie in one are the triangles of the boundary. *)
  boundary : forall a b c, NoDup [a; b; c] -> (in_boundary T a b c <-> face B a b c);
  (** The links of the edges are paths and cycles, one each. *)
  edge_links : forall a b, a <> b -> path (spans T a b) \/ cycle (spans T a b);
  (** The links of the vertices are discs, as all eight of them are on the boundary. *)
  vertex_links : forall v, exists D, disc D /\ forall a b c, face D a b c <-> spans T v a b c
}.

Definition triangulation (T : list tetrahedron) : Prop :=
  exists B, In B boundaries /\ bounded_by B T.

(** ** Symmetries

    The 48 symmetries of the cube: they permute the vertices, and take facets to facets. *)
Definition symmetry (s : vertex -> vertex) : Prop :=
  (forall u v, s u = s v -> u = v) /\
  forall f, In f facets -> exists g, In g facets /\ Permutation (map s (vertices f)) (vertices g).

Definition equivalent (T U : list tetrahedron) : Prop :=
  exists s, symmetry s /\ forall a b c d, spans T a b c d <-> spans U (s a) (s b) (s c) (s d).
