(** * Links: Euler's formula, and connectedness

    What the definition of a triangulation says of numbers of faces:

    - a disc has vertices - edges + triangles = 1 ([euler_disc]), by induction along its shelling;
    - so, if b triangles of the boundary and i used edges off the boundary meet at a vertex, then
      b - 2 + 2i tetrahedra do ([tetrahedra_at_vertex]);
    - and a link of an edge has no part that is closed in itself ([no_closed_part]). *)

From Coq Require Import List Bool Permutation PeanoNat Lia.
From Certify Require Import Barycentric Integral Faces.
Import ListNotations.

(** ** Euler's formula for discs *)

Lemma all_triples (f : vertex -> vertex -> vertex -> bool) :
  forallb (fun a => forallb (fun b => forallb (f a b) all_vertices) all_vertices) all_vertices
    = true ->
  forall a b c, f a b c = true.
Proof.
  intros h a b c. rewrite forallb_forall in h. specialize (h a (in_all_vertices a)).
  rewrite forallb_forall in h. specialize (h b (in_all_vertices b)).
  rewrite forallb_forall in h. exact (h c (in_all_vertices c)).
Qed.

Definition euler (f : list vertex -> bool) (characteristic : nat) : Prop :=
  count f (faces 1) + count f (faces 3) = count f (faces 2) + characteristic.

(** The faces of a triangle abc that contain certain vertices n of it. All of them together have
    the characteristic 1, those with c have 0 (a vertex, two edges, a triangle), and those with
    a and c too (an edge, a triangle). *)
Lemma euler_new a b c : NoDup [a; b; c] ->
  euler (fun f => subset f [a; b; c] && subset [] f) 1 /\
  euler (fun f => subset f [a; b; c] && subset [c] f) 0 /\
  euler (fun f => subset f [a; b; c] && subset [a; c] f) 0.
Proof.
  unfold euler. intro h. apply distinct_iff in h. rewrite <- !Nat.eqb_eq, <- !andb_true_iff.
  revert a b c h.
  assert (k : forall a b c, implb (distinct [a; b; c])
    (let test n x := let g := fun f => subset f [a; b; c] && subset n f in
       count g (faces 1) + count g (faces 3) =? count g (faces 2) + x in
     test [] 1 && (test [c] 0 && test [a; c] 0)) = true).
  { apply all_triples. vm_compute. reflexivity. }
  intros a b c h. specialize (k a b c). now rewrite h in k.
Qed.

(** Glue a triangle abc to D, where the faces of abc that are not yet in D are those with n. *)
Lemma euler_glue D a b c n x y :
  (forall k f, In f (faces (S k)) -> subset f [a; b; c] = true -> covers D f = negb (subset n f)) ->
  euler (covers D) x -> euler (fun f => subset f [a; b; c] && subset n f) y ->
  euler (covers ((a, b, c) :: D)) (x + y).
Proof.
  intro h. assert (e : forall k, count (covers ((a, b, c) :: D)) (faces (S k)) =
    count (covers D) (faces (S k)) +
    count (fun f => subset f [a; b; c] && subset n f) (faces (S k))).
  { intro k. rewrite !count_total, <- total_add. apply total_ext. intros f i. specialize (h k f i).
    rewrite covers_cons. cbn [corners].
    destruct (subset f [a; b; c]); [rewrite h by auto; destruct (subset n f) | simpl]; simpl; lia. }
  unfold euler. rewrite !e. lia.
Qed.

Lemma face_edge D a b c : face D a b c -> covers D [a; b] = true.
Proof.
  intros (t & i & h). apply covers_iff. exists t. split; auto. apply subset_iff.
  intros v j. apply (Permutation_in v h). simpl in *. tauto.
Qed.
Lemma rim_covers D a b f : rim D a b -> subset f [a; b] = true -> covers D f = true.
Proof.
  intros (c & h & _) k. apply face_edge in h. apply covers_iff in h as (t & i & h).
  apply covers_iff. exists t. eauto using subset_trans.
Qed.
(** The six orders of the corners of a triangle. *)
Lemma face_orders D x y z : In (x, y, z) D ->
  face D x y z /\ face D x z y /\ face D y x z /\ face D y z x /\ face D z x y /\ face D z y x.
Proof.
  intro i. assert (h : forall l : list vertex, Permutation l [x; y; z] ->
    exists t, In t D /\ Permutation l (corners t)) by (intros l h; exists (x, y, z); auto).
  repeat split; apply h.
  - apply Permutation_refl.
  - apply perm_skip, perm_swap.
  - apply perm_swap.
  - apply Permutation_sym, Permutation_cons_append with (l := [y; z]).
  - apply Permutation_cons_append with (l := [x; y]).
  - apply Permutation_rev with (l := [z; y; x]).
Qed.
Lemma no_vertex D c f : ~ has_vertex D c -> In c f -> covers D f = false.
Proof.
  intros h i. apply not_true_iff_false. intro k. apply covers_iff in k as ([[x y] z] & j & k).
  rewrite subset_iff in k. apply k in i. apply h.
  destruct (face_orders D x y z j) as (o1 & _ & o2 & _ & o3 & _).
  destruct i as [<- | [<- | [<- | []]]]; eexists; eexists; eassumption.
Qed.
Lemma no_edge D a c f : a <> c -> ~ edge D a c -> In a f -> In c f -> covers D f = false.
Proof.
  intros ne h i i'. apply not_true_iff_false. intro k. apply covers_iff in k as ([[x y] z] & j & k).
  rewrite subset_iff in k. apply k in i, i'. apply h.
  destruct (face_orders D x y z j) as (o1 & o2 & o3 & o4 & o5 & o6).
  destruct i as [<- | [<- | [<- | []]]], i' as [<- | [<- | [<- | []]]];
    try congruence; eexists; eassumption.
Qed.
Lemma subset_cons v f g : subset (v :: f) g = mem v g && subset f g.
Proof. reflexivity. Qed.
Lemma disc_nodup D : disc D -> forall t, In t D -> NoDup (corners t).
Proof.
  assert (ne : forall D a b,
    disc D -> (forall t, In t D -> NoDup (corners t)) -> rim D a b -> a <> b).
  { intros D' a b _ h (c & (t & i & p) & _). apply h in i.
    pose proof (Permutation_NoDup (Permutation_sym p) i) as n. inversion n; simpl in *. intuition. }
  induction 1 as [a b c n | D a b c d IH r np | D a b c d IH r r' nac n]; simpl.
  - intros t [<- | []]; auto.
  - intros t [<- | i]; auto. pose proof (ne D a b d IH r). destruct r as (z & f & _).
    destruct f as (t & i & p). assert (q : forall x, In x [a; b] -> c <> x).
    { intros x j ->. apply np. destruct t as [[u v] w].
      assert (k : In x (corners (u, v, w))) by (apply (Permutation_in x p); simpl in *; tauto).
      destruct (face_orders D u v w i) as (o1 & _ & o2 & _ & o3 & _).
      destruct k as [<- | [<- | [<- | []]]]; eexists; eexists; eassumption. }
    pose proof (q a). pose proof (q b). simpl in *. repeat constructor; simpl; intuition.
  - intros t [<- | i]; auto. pose proof (ne D a b d IH r). pose proof (ne D b c d IH r').
    repeat constructor; simpl; intuition.
Qed.

Theorem euler_disc D : disc D -> euler (covers D) 1.
Proof.
  intro d. pose proof (disc_nodup D d) as nodup.
  induction d as [a b c n | D a b c d IH r np | D a b c d IH r r' nac ne].
  - change 1 with (0 + 1). apply euler_glue with (n := []); [reflexivity | reflexivity |].
    now apply (euler_new a b c).
  - assert (n : NoDup [a; b; c]) by apply (nodup (a, b, c) (or_introl eq_refl)).
    change 1 with (1 + 0). apply euler_glue with (n := [c]); [| | now apply (euler_new a b c)].
    + intros k f i h. rewrite subset_cons, andb_true_r. destruct (mem c f) eqn:m.
      * apply mem_iff in m. now apply (no_vertex D c).
      * apply mem_false in m. apply (rim_covers D a b); auto. rewrite subset_iff in *.
        intros v j. specialize (h v j). simpl in *. intuition congruence.
    + apply IH. intros t i. apply nodup. now right.
  - assert (n : NoDup [a; b; c]) by apply (nodup (a, b, c) (or_introl eq_refl)).
    change 1 with (1 + 0). apply euler_glue with (n := [a; c]); [| | now apply (euler_new a b c)].
    + intros k f i h. rewrite !subset_cons, andb_true_r. rewrite subset_iff in h.
      destruct (mem a f) eqn:m; [destruct (mem c f) eqn:m' |].
      * apply mem_iff in m, m'. now apply (no_edge D a c).
      * apply mem_false in m'. apply (rim_covers D a b); auto. apply subset_iff.
        intros v j. specialize (h v j). simpl in *. intuition congruence.
      * apply mem_false in m. apply (rim_covers D b c); auto. apply subset_iff.
        intros v j. specialize (h v j). simpl in *. intuition congruence.
    + apply IH. intros t i. apply nodup. now right.
Qed.

(** ** Graphs that are one path or one cycle have no closed part *)

Lemma consecutive_later v l x y : consecutive l x y -> consecutive (v :: l) x y.
Proof. intros (before & after & ->). now exists (v :: before), after. Qed.
Lemma consecutive_in l x y : consecutive l x y -> In x l /\ In y l.
Proof. intros (before & after & ->). rewrite !in_app_iff. simpl. tauto. Qed.
Lemma along (A : Type) (part : vertex -> A) l :
  (forall x y, consecutive l x y -> part x = part y) ->
  forall x y, In x l -> In y l -> part x = part y.
Proof.
  assert (first : forall l v, (forall x y, consecutive (v :: l) x y -> part x = part y) ->
    forall x, In x l -> part v = part x).
  { clear l. induction l as [| w l IH]; simpl; [tauto |]. intros v h.
    assert (e : part v = part w) by (apply h; now exists [], l).
    intros x [<- | i]; auto. rewrite e. apply (IH w); auto using consecutive_later. }
  destruct l as [| v l]; [now intros ? ? ? [] |]. intros h x y.
  pose proof (first l v h) as k. intros [<- | i] [<- | j]; auto; [symmetry; auto |].
  rewrite <- (k x i). auto.
Qed.
Lemma connected (A : Type) joined (part : vertex -> A) : path joined \/ cycle joined ->
  (forall x y, joined x y -> part x = part y) ->
  forall x y x' y', joined x y -> joined x' y' -> part x = part x'.
Proof.
  intros p h. assert (w : exists l, forall x y, joined x y <-> neighbours l x y)
    by (destruct p as [(l & _ & e) | (v & l & _ & _ & e)]; eauto).
  destruct w as (l & e). intros x y x' y' j j'. apply (along A part l).
  - intros u v c. apply h, e. now left.
  - apply e in j as [j | j]; now apply consecutive_in in j.
  - apply e in j' as [j' | j']; now apply consecutive_in in j'.
Qed.

(** ** Numbers of faces at a vertex *)

(** Facts about the faces on eight vertices, by computation. *)
Lemma faces_at v k : 1 <= k <= 3 ->
  map (fun f => increasing (v :: f)) (filter (fun f => negb (mem v f)) (faces k)) =
  filter (mem v) (faces (S k)).
Proof. intro h. destruct k as [| [| [| [|]]]]; try lia; destruct v; vm_compute; reflexivity. Qed.
Lemma faces_around f : In f (faces 3) ->
  map (fun d => increasing (d :: f)) (filter (fun d => negb (mem d f)) all_vertices) =
  filter (subset f) (faces 4).
Proof. revert f. apply map_ext_in_iff. vm_compute. reflexivity. Qed.
Lemma three_triangles v q : In q (faces 4) ->
  count (fun f => subset f q) (filter (mem v) (faces 3)) = 3 * Nat.b2n (mem v q).
Proof. revert q. apply map_ext_in_iff. destruct v; vm_compute; reflexivity. Qed.

(** The number of tetrahedra at a triangle. *)
Definition degree (T : list tetrahedron) (f : list vertex) : nat :=
  count (used T) (filter (subset f) (faces 4)).

Section Degrees.
Variable T : list tetrahedron.
Hypothesis T_nodup : forall t, In t T -> NoDup (vertices t).

Lemma degree_apexes a b c ds : In [a; b; c] (faces 3) -> apexes T a b c ds ->
  degree T [a; b; c] = length ds.
Proof.
  intros i [n h]. pose proof (face_nodup 3 _ ltac:(lia) i) as [m _].
  unfold degree. rewrite <- faces_around, count_map, count_filter, count_length by auto.
  apply Permutation_length, NoDup_Permutation; auto using NoDup_filter, all_vertices_nodup.
  intro d. rewrite filter_In, h, (spans_used T T_nodup), andb_true_iff, negb_true_iff, mem_false.
  rewrite (used_same T (increasing (d :: [a; b; c])) [a; b; c; d]).
  - assert (e : NoDup [a; b; c; d] <-> ~ In d [a; b; c]).
    { pose proof (Permutation_cons_append [a; b; c] d) as p. split.
      - intro k. apply (Permutation_NoDup (Permutation_sym p)) in k. now inversion k.
      - intro k. apply (Permutation_NoDup p). now constructor. }
    pose proof (in_all_vertices d). tauto.
  - intro x. rewrite in_increasing. simpl. tauto.
Qed.
Lemma used_degree f : used T f = true <-> degree T f <> 0.
Proof.
  unfold degree. split.
  - intros h e. apply (used_tetrahedron T T_nodup) in h as (q & i & s & u).
    rewrite count_zero in e. rewrite (e q) in u; [discriminate |]. now apply filter_In.
  - intro h. apply count_some in h as (q & i & u). apply filter_In in i as [_ i].
    now apply (used_subset T f q).
Qed.
End Degrees.

Lemma facet_nodup f : In f facets -> NoDup (vertices f).
Proof.
  assert (e : forallb (fun f => distinct (vertices f)) facets = true) by reflexivity.
  rewrite forallb_forall in e. intro i. now apply distinct_iff, e.
Qed.

Section Triangulation.
Variable B : list triangle.
Variable T : list tetrahedron.
Hypothesis tri : bounded_by B T.

Lemma T_nodup t : In t T -> NoDup (vertices t).
Proof. intro i. now apply (proper B T tri) in i. Qed.
Lemma spans_iff a b c d : spans T a b c d <-> NoDup [a; b; c; d] /\ used T [a; b; c; d] = true.
Proof. apply spans_used, T_nodup. Qed.
Lemma facet_not_used f : In f facets -> used T (vertices f) = false.
Proof.
  intro i. apply not_true_iff_false. intro h. apply used_iff in h as (t & j & h).
  apply (proper B T tri) in j as [n k]. apply (k f i), Permutation_sym, permutation_subset.
  - now apply facet_nodup.
  - now rewrite !length_vertices.
  - exact h.
Qed.

(** The link of v covers f if v joined with f is a face of T. *)
Lemma link_covers D v f : (forall a b c, face D a b c <-> spans T v a b c) ->
  covers D f = negb (mem v f) && used T (v :: f).
Proof.
  intro h. apply eq_true_iff_eq. rewrite andb_true_iff, negb_true_iff, mem_false. split.
  - intro k. apply covers_iff in k as ([[a b] c] & i & k). cbn [corners] in k.
    assert (s : spans T v a b c) by (apply h; exists (a, b, c); auto).
    apply spans_iff in s as [n s]. rewrite subset_iff in k. split.
    + intro j. apply k in j. now inversion n.
    + apply (used_subset T _ _) with (2 := s). apply subset_iff. intros x [<- | j]; [now left |].
      right. auto.
  - intros [n k]. apply used_iff in k as (t & i & k). rewrite subset_iff in k.
    destruct (in_split v (vertices t)) as (l & m & e); [apply k; now left |].
    pose proof (Permutation_middle l m v) as p. rewrite <- e in p.
    pose proof (Permutation_length p) as len. rewrite length_vertices in len.
    destruct (l ++ m) as [| a [| b [| c [|]]]]; try discriminate.
    assert (s : face D a b c) by (apply h; exists t; auto).
    destruct s as (u & j & q). apply covers_iff. exists u. split; auto. apply subset_iff.
    intros x ix. apply (Permutation_in x q).
    assert (o : In x (v :: [a; b; c])).
    { apply (Permutation_in x (Permutation_sym p)), k. now right. }
    destruct o as [<- | o]; [contradiction | exact o].
Qed.

Definition at_vertex (v : vertex) (k : nat) : nat := count (used T) (filter (mem v) (faces k)).

(** Euler's formula for the link of v: edges at v + tetrahedra at v = triangles at v + 1. *)
Lemma euler_link v : at_vertex v 2 + at_vertex v 4 = at_vertex v 3 + 1.
Proof.
  destruct (vertex_links B T tri v) as (D & d & h). pose proof (euler_disc D d) as e.
  assert (k : forall k, 1 <= k <= 3 -> count (covers D) (faces k) = at_vertex v (S k)).
  { intros k hk. unfold at_vertex. rewrite <- faces_at, count_map, count_filter by auto.
    apply count_ext. intros f _. rewrite (link_covers D v f h). f_equal. apply used_same.
    intro x. symmetry. apply in_increasing. }
  unfold euler in e. rewrite !k in e by lia. exact e.
Qed.

Lemma degree_cases f : In f (faces 3) ->
  if covers B f then degree T f = 1 else degree T f = 0 \/ degree T f = 2.
Proof.
  intro i. pose proof (face_3 f i) as (a & b & c & -> & n).
  destruct (covers B [a; b; c]) eqn:e.
  - apply face_covers, (boundary B T tri) in e as [d h]; auto.
    now apply (degree_apexes T T_nodup _ _ _ [d]).
  - destruct (at_most_two B T tri a b c n) as (ds & h & le).
    rewrite (degree_apexes T T_nodup a b c ds i h).
    destruct ds as [| d [| d' [|]]]; simpl in *; try lia.
    exfalso. apply not_true_iff_false in e. apply e, face_covers, (boundary B T tri); auto.
    now exists d.
Qed.
Lemma degree_used f : In f (faces 3) -> degree T f + Nat.b2n (covers B f) = 2 * Nat.b2n (used T f).
Proof.
  intro i. pose proof (degree_cases f i) as h. pose proof (used_degree T T_nodup f) as u.
  destruct (covers B f), (used T f); simpl; intuition lia.
Qed.

(** Each tetrahedron at v has three triangles at v. *)
Definition boundary_triangles (v : vertex) : nat := count (covers B) (filter (mem v) (faces 3)).
Lemma triangles_at_vertex v : 3 * at_vertex v 4 + boundary_triangles v = 2 * at_vertex v 3.
Proof.
  assert (e : total (degree T) (filter (mem v) (faces 3)) = 3 * at_vertex v 4).
  { unfold degree, at_vertex. rewrite count_filter, (count_total _ (faces 4)), <- total_scale.
    rewrite (total_ext _ (fun f => total (fun q => Nat.b2n (subset f q && used T q)) (faces 4)))
      by (intros f _; now rewrite count_filter, count_total).
    rewrite total_swap. apply total_ext. intros q i. rewrite <- count_total.
    pose proof (three_triangles v q i) as k. destruct (used T q).
    - rewrite andb_true_r, <- k. apply count_ext. intros f _. apply andb_true_r.
    - rewrite andb_false_r. apply count_zero. intros f _. apply andb_false_r. }
  rewrite <- e. unfold boundary_triangles, at_vertex.
  rewrite !count_total, <- total_add, <- total_scale.
  apply total_ext. intros f i. apply filter_In in i as [i _]. now apply degree_used.
Qed.

(** The boundary is a closed surface: its triangles have three corners, and at a vertex there are
    as many edges as triangles, at least two. (For a given boundary this is computed.) *)
Definition closed_surface : bool :=
  forallb (fun t => distinct (corners t)) B &&
  forallb (fun v => (count (covers B) (filter (mem v) (faces 2)) =? boundary_triangles v) &&
                    (2 <=? boundary_triangles v)) all_vertices.
Hypothesis closed : closed_surface = true.

Lemma boundary_used f : covers B f = true -> used T f = true.
Proof.
  intro h. apply covers_iff in h as (t & i & h).
  pose proof closed as n. apply andb_true_iff in n as [n _].
  rewrite forallb_forall in n. specialize (n t i). apply distinct_iff in n.
  assert (j : In (increasing (corners t)) (faces 3)).
  { rewrite <- (length_corners t). now apply increasing_face. }
  assert (e : forall v, In v (increasing (corners t)) <-> In v (corners t))
    by (intro; apply in_increasing).
  apply (used_subset T f (increasing (corners t))).
  - rewrite (subset_same f f _ (corners t)); [exact h | tauto | exact e].
  - apply (used_degree T T_nodup). pose proof (degree_cases _ j) as d.
    replace (covers B (increasing (corners t))) with true in d; [lia |].
    symmetry. apply covers_iff. exists t. split; auto. apply subset_iff. intros v. apply e.
Qed.

(** The edges off the boundary. *)
Definition inner_edges : list (list vertex) := filter (fun e => negb (covers B e)) (faces 2).

Theorem tetrahedra_at_vertex v : 2 <= boundary_triangles v /\
  at_vertex v 4 + 2 = boundary_triangles v + 2 * count (used T) (filter (mem v) inner_edges).
Proof.
  pose proof (euler_link v) as e. pose proof (triangles_at_vertex v) as t.
  pose proof closed as c. apply andb_true_iff in c as [_ c].
  rewrite forallb_forall in c. specialize (c v (in_all_vertices v)).
  apply andb_true_iff in c as [c c']. apply Nat.eqb_eq in c. apply Nat.leb_le in c'.
  assert (s : at_vertex v 2 = boundary_triangles v + count (used T) (filter (mem v) inner_edges)).
  { rewrite <- c. unfold at_vertex, inner_edges.
    rewrite (count_split (used T) (covers B)), !count_filter. f_equal; apply count_ext; intros f _.
    - pose proof (boundary_used f) as u. destruct (mem v f), (covers B f); simpl; auto.
    - destruct (mem v f), (covers B f), (used T f); auto. }
  lia.
Qed.

(** ** The link of an edge

    Let every vertex of C have two neighbours in C, in the link of the edge ab. There are no more
    than two, so that no edge of the link leaves C; as the link is connected, no vertex of it is
    outside C. *)
Theorem no_closed_part a b C x o y : a <> b ->
  (forall u, In u C ->
    exists p q, In p C /\ In q C /\ p <> q /\ spans T a b u p /\ spans T a b u q) ->
  In x C -> ~ In o C -> spans T a b o y -> False.
Proof.
  intros ne two ix no so.
  assert (stay : forall u w, spans T a b u w -> In u C -> In w C).
  { intros u w s i. destruct (two u i) as (p & q & ip & iq & pq & sp & sq).
    assert (n : NoDup [a; b; u]).
    { apply spans_iff in s as [s _]. apply (NoDup_remove_1 [a; b; u] [] w) in s. exact s. }
    destruct (at_most_two B T tri a b u n) as (ds & [_ d] & le).
    apply d in s, sp, sq.
    destruct ds as [| e [| e' [|]]]; simpl in *; try lia; intuition congruence. }
  assert (swap : forall u w, spans T a b u w -> spans T a b w u).
  { intros u w. apply spans_permutation, perm_skip, perm_skip, perm_swap. }
  assert (e : mem x C = mem o C).
  { destruct (two x ix) as (p & _ & _ & _ & _ & s & _).
    apply (connected bool (spans T a b) (fun v => mem v C) (edge_links B T tri a b ne))
      with (y := p) (y' := y); auto.
    intros u w s'. apply eq_true_iff_eq. rewrite !mem_iff. split; eauto. }
  apply mem_iff in ix. apply mem_false in no. congruence.
Qed.
End Triangulation.
