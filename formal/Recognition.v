(** * Recognizing triangulations, and telling them apart

    Tests that compute, with proofs that they are right: that a list of tetrahedra triangulates the
    hexahedron ([triangulates_sound]), and that two are not equivalent ([all_differ_sound]).

    Paths, cycles and shellings are searched for; how need not concern whoever believes the result,
    since what is found is tested. *)

From Coq Require Import List Bool Permutation PeanoNat PArith Lia.
From Certify Require Import Barycentric Integral Faces Links Symmetry.
Import ListNotations.
Local Open Scope lazy_bool_scope.

(** ** Discs *)

Definition rim_test (D : list triangle) (a b : vertex) : bool :=
  count (fun c => covers D [a; b; c] &&& distinct [a; b; c]) all_vertices =? 1.
Definition glues_one (D : list triangle) (t : triangle) : bool :=
  let '(a, b, c) := t in rim_test D a b &&& negb (covers D [c]).
Definition glues_two (D : list triangle) (t : triangle) : bool :=
  let '(a, b, c) := t in
  rim_test D a b &&& (rim_test D b c &&& (negb (same_vertex a c) &&& negb (covers D [a; c]))).

(** The last triangle of the list is the first of the shelling. *)
Fixpoint shelling (D : list triangle) : bool :=
  match D with
  | [] => false
  | [t] => distinct (corners t)
  | t :: D' => (glues_one D' t ||| glues_two D' t) &&& shelling D'
  end.

Lemma count_one A (f : A -> bool) l : count f l = 1 ->
  exists x, f x = true /\ forall y, In y l -> f y = true -> x = y.
Proof.
  induction l as [| x l IH]; simpl; [discriminate |]. destruct (f x) eqn:e; simpl.
  - intro h. exists x. split; auto. intros y [<- | i] k; auto. exfalso.
    assert (z : count f l = 0) by lia. rewrite count_zero in z. rewrite (z y i) in k. discriminate.
  - intro h. destruct (IH h) as (y & t & u). exists y. split; auto.
    intros z [<- | i] k; [congruence | auto].
Qed.
Lemma face_nodup_covers D a b c : disc D ->
  (face D a b c <-> (covers D [a; b; c] &&& distinct [a; b; c]) = true).
Proof.
  intro d. rewrite lazy_and, distinct_iff. split.
  - intro h. assert (n : NoDup [a; b; c]).
    { destruct h as (t & i & p). apply (Permutation_NoDup (Permutation_sym p)).
      now apply (disc_nodup D d). }
    split; auto. now apply face_covers.
  - intros [h n]. now apply face_covers.
Qed.
Lemma rim_test_sound D a b : disc D -> rim_test D a b = true -> rim D a b.
Proof.
  intros d h. apply Nat.eqb_eq, count_one in h as (c & t & u). exists c. split.
  - now apply face_nodup_covers.
  - intros e k. apply u; [apply in_all_vertices | now apply face_nodup_covers].
Qed.
Lemma shelling_sound D : shelling D = true -> disc D.
Proof.
  induction D as [| [[a b] c] D IH]; [discriminate |]. destruct D as [| t D].
  - intro h. constructor. now apply distinct_iff.
  - intro h. cbn [shelling] in h. apply lazy_and in h as [h d]. apply IH in d.
    clear IH. revert h d. generalize (t :: D). clear t D. intros D h d.
    apply lazy_or in h as [h | h]; unfold glues_one, glues_two in h.
    + apply lazy_and in h as [r n]. apply negb_true_iff in n.
      apply glue_one_edge; auto using rim_test_sound. intros (x & y & k).
      apply face_edge in k. apply not_true_iff_false in n. apply n.
      apply covers_iff in k as (u & i & s). apply covers_iff. exists u. split; auto.
      apply subset_trans with (2 := s). apply subset_iff. intros v [<- | []]. now left.
    + rewrite !lazy_and, !negb_true_iff in h. destruct h as (r & r' & ne & n).
      apply glue_two_edges; auto using rim_test_sound.
      * intros <-. apply not_true_iff_false in ne. now apply ne, same_vertex_iff.
      * intros (x & k). apply face_edge in k. congruence.
Qed.

(** Take the triangles one by one in an order in which each can be glued to those before. *)
Definition turns (t : triangle) : list triangle :=
  let '(a, b, c) := t in [(a, b, c); (b, c, a); (c, a, b)].
Definition glues (D : list triangle) (t : triangle) : bool :=
  match D with [] => true | _ => glues_one D t ||| glues_two D t end.
Fixpoint shell (fuel : nat) (D : list triangle) (left : list (list vertex)) : list triangle :=
  match fuel with
  | 0 => D
  | S fuel' =>
      match find (glues D) (flat_map (fun f =>
        match f with [a; b; c] => turns (a, b, c) | _ => [] end) left) with
      | Some t => shell fuel' (t :: D) (filter (fun f => negb (subset f (corners t))) left)
      | None => D
      end
  end.

Section Test.
Variable T : list tetrahedron.

Definition spans_test (a b c d : vertex) : bool := used T [a; b; c; d] &&& distinct [a; b; c; d].

Definition vertex_test (v : vertex) : bool :=
  let in_link f := negb (mem v f) &&& used T (v :: f) in
  let link := filter in_link (faces 3) in
  let D := shell (length link) [] link in
  shelling D &&& every (fun f => eqb (covers D f) (in_link f)) (faces 3).

(** ** Paths and cycles *)

Fixpoint consecutive_test (l : list vertex) (x y : vertex) : bool :=
  match l with
  | u :: (v :: _) as l' => (same_vertex u x &&& same_vertex v y) ||| consecutive_test l' x y
  | _ => false
  end.
Definition graph_test (joined : vertex -> vertex -> bool) (l : list vertex) : bool :=
  every (fun x => every (fun y =>
    eqb (joined x y) (consecutive_test l x y ||| consecutive_test l y x)) all_vertices)
    all_vertices.

(** From a vertex go on to neighbours that were not seen, as long as there are any. *)
Fixpoint trace (fuel : nat) (joined : vertex -> vertex -> bool) (seen : list vertex) (x : vertex)
  : list vertex :=
  match fuel with
  | 0 => [x]
  | S fuel' =>
      match find (fun y => joined x y &&& negb (mem y (x :: seen))) all_vertices with
      | Some y => x :: trace fuel' joined (x :: seen) y
      | None => [x]
      end
  end.
(** A function on the vertices, with all its values computed once. *)
Definition tabulate {A} (f : vertex -> A) : vertex -> A :=
  let y1 := f V1 in let y2 := f V2 in let y3 := f V3 in let y4 := f V4 in
  let y5 := f V5 in let y6 := f V6 in let y7 := f V7 in let y8 := f V8 in
  fun v => match v with V1 => y1 | V2 => y2 | V3 => y3 | V4 => y4
                      | V5 => y5 | V6 => y6 | V7 => y7 | V8 => y8 end.
Lemma tabulate_value A (f : vertex -> A) v : tabulate f v = f v.
Proof. now destruct v. Qed.

Definition edge_test (a b : vertex) : bool :=
  let joined := tabulate (fun x => tabulate (spans_test a b x)) in
  let valence x := count (joined x) all_vertices in
  match find (fun x => valence x =? 1) all_vertices with
  | Some x => let l := trace 8 joined [] x in distinct l &&& graph_test joined l
  | None =>
      match find (fun x => negb (valence x =? 0)) all_vertices with
      | None => graph_test joined []
      | Some x =>
          match trace 8 joined [] x with
          | v :: l => distinct (v :: l) &&& ((2 <=? length l) &&& graph_test joined (v :: l ++ [v]))
          | [] => false
          end
      end
  end.

Lemma consecutive_sound l x y : consecutive_test l x y = true <-> consecutive l x y.
Proof.
  induction l as [| u [| v l] IH].
  - split; [discriminate |]. intros ([| ? ?] & ? & e); discriminate.
  - split; [discriminate |]. intros ([| ? [| ? ?]] & ? & e); discriminate.
  - cbn [consecutive_test] in *. rewrite lazy_or, lazy_and, !same_vertex_iff, IH. split.
    + intros [[<- <-] | h]; [now exists [], l | now apply consecutive_later].
    + intros ([| w before] & after & e).
      * injection e as <- <- <-. now left.
      * right. injection e as <- e. now exists before, after.
Qed.
Lemma graph_sound joined joined' l : (forall x y, joined x y = true <-> joined' x y) ->
  graph_test joined l = true -> forall x y, joined' x y <-> neighbours l x y.
Proof.
  intros e h x y. unfold graph_test in h. rewrite every_forall in h.
  specialize (h x (in_all_vertices x)). rewrite every_forall in h.
  specialize (h y (in_all_vertices y)). apply eqb_prop in h.
  unfold neighbours. rewrite <- e, h, lazy_or, !consecutive_sound. tauto.
Qed.

(** ** The whole *)

Definition proper_test : bool :=
  every (fun t => distinct (vertices t) &&&
    every (fun f => negb (subset (vertices t) (vertices f))) facets) T.
Definition triangles_test : bool := every (fun f => degree T f <=? 2) (faces 3).
Definition border : list (list vertex) := filter (fun f => degree T f =? 1) (faces 3).
Definition boundary_test (border : list (list vertex)) (B : list triangle) : bool :=
  every (covers B) border &&&
  (every (fun t => any (fun f => subset f (corners t)) border) B &&&
  every (fun t => distinct (corners t)) B).
Definition triangulates : bool :=
  proper_test &&& (triangles_test &&&
  (every (fun e => match e with [a; b] => edge_test a b | _ => false end) (faces 2) &&&
  (every vertex_test all_vertices &&&
  let border := border in any (boundary_test border) boundaries))).

Hypothesis ok : proper_test = true.
Lemma tested_nodup t : In t T -> NoDup (vertices t).
Proof.
  intro i. pose proof ok as h. unfold proper_test in h. rewrite every_forall in h.
  apply h, lazy_and in i as [i _]. now apply distinct_iff.
Qed.
Lemma spans_tested a b c d : spans_test a b c d = true <-> spans T a b c d.
Proof.
  unfold spans_test. rewrite (spans_used T tested_nodup), lazy_and, distinct_iff. tauto.
Qed.
Lemma edge_sound a b : edge_test a b = true -> path (spans T a b) \/ cycle (spans T a b).
Proof.
  unfold edge_test. cbv zeta. set (joined := tabulate (fun x => tabulate (spans_test a b x))).
  assert (s : forall x y, joined x y = true <-> spans T a b x y).
  { intros x y. unfold joined. rewrite !tabulate_value. apply spans_tested. }
  clearbody joined. destruct (find _ all_vertices) as [x |].
  - intro h. apply lazy_and in h as [n h]. left. exists (trace 8 joined [] x).
    split; [now apply distinct_iff | now apply (graph_sound joined)].
  - destruct (find _ all_vertices) as [x |].
    + destruct (trace _ _ _ x) as [| v l]; [discriminate |]. intro h.
      rewrite !lazy_and in h. destruct h as (n & le & g). right. exists v, l.
      split; [now apply distinct_iff |]. split; [now apply Nat.leb_le |].
      now apply (graph_sound joined).
    + intro h. left. exists []. split; [constructor | now apply (graph_sound joined)].
Qed.
Lemma edge_swap a b : path (spans T a b) \/ cycle (spans T a b) ->
  path (spans T b a) \/ cycle (spans T b a).
Proof.
  assert (s : forall x y, spans T b a x y <-> spans T a b x y)
    by (intros; split; apply spans_permutation, perm_swap).
  intros [(l & n & h) | (v & l & n & k & h)]; [left; exists l | right; exists v, l];
    repeat split; auto; intro j; now apply h, s || now apply s, h.
Qed.
Lemma vertex_sound v : vertex_test v = true ->
  exists D, disc D /\ forall a b c, face D a b c <-> spans T v a b c.
Proof.
  unfold vertex_test. cbv zeta. set (D := shell _ _ _). intro h.
  apply lazy_and in h as [d h]. apply shelling_sound in d. exists D. split; auto.
  intros a b c. rewrite (face_nodup_covers D a b c d), lazy_and, distinct_iff.
  rewrite (spans_used T tested_nodup).
  assert (k : NoDup [a; b; c] ->
    covers D [a; b; c] = negb (mem v [a; b; c]) && used T [v; a; b; c]).
  { intro n. rewrite every_forall in h. specialize (h _ (increasing_face _ n)).
    assert (e : forall w, In w (increasing [a; b; c]) <-> In w [a; b; c])
      by (intro; apply in_increasing).
    apply eqb_prop in h. set (f := increasing [a; b; c]) in *.
    change (covers D f = negb (mem v f) && used T (v :: f)) in h.
    rewrite (covers_same D _ [a; b; c]) in h by exact e. rewrite h. f_equal.
    - f_equal. apply eq_true_iff_eq. rewrite !mem_iff. apply e.
    - apply used_same. intro w. specialize (e w). cbn [In] in *. tauto. }
  rewrite (NoDup_cons_iff v [a; b; c]). split.
  - intros [h' n]. rewrite k, andb_true_iff, negb_true_iff, mem_false in h' by exact n. tauto.
  - intros [[o n] u]. split; auto. rewrite k by exact n. rewrite u, andb_true_r.
    now apply negb_true_iff, mem_false.
Qed.
Lemma apexes_tested a b c : NoDup [a; b; c] ->
  exists ds, apexes T a b c ds /\ length ds = degree T (increasing [a; b; c]).
Proof.
  intro n. exists (filter (spans_test a b c) all_vertices).
  assert (ap : apexes T a b c (filter (spans_test a b c) all_vertices)).
  { split; [apply NoDup_filter, all_vertices_nodup |]. intro d. rewrite filter_In, spans_tested.
    pose proof (in_all_vertices d). tauto. }
  split; auto. pose proof (increasing_face _ n) as i. pose proof (increasing_permutation _ n) as p.
  destruct (face_3 _ i) as (x & y & z & e & _). rewrite e in *.
  symmetry. apply degree_apexes; auto using tested_nodup. destruct ap as [n' h]. split; auto.
  intro d. rewrite h. split; apply spans_permutation;
    [apply Permutation_sym in p |]; now apply (Permutation_app_tail [d]) in p.
Qed.
Lemma apexes_unique a b c ds es : apexes T a b c ds -> apexes T a b c es -> length ds = length es.
Proof.
  intros [n h] [m k]. apply Permutation_length, NoDup_Permutation; auto.
  intro d. now rewrite h, k.
Qed.

Lemma boundary_sound B : boundary_test border B = true ->
  forall a b c, NoDup [a; b; c] -> (in_boundary T a b c <-> face B a b c).
Proof.
  unfold boundary_test. rewrite !lazy_and, !every_forall. intros (h2 & h1 & nB) a b c n.
  destruct (apexes_tested a b c n) as (ds & ap & len). pose proof (increasing_face _ n) as i.
  assert (e : in_boundary T a b c <-> In (increasing [a; b; c]) border).
  { unfold border. rewrite filter_In, Nat.eqb_eq, <- len. split.
    - intros (d & h). split; auto. now rewrite (apexes_unique _ _ _ _ _ ap h).
    - intros [_ h]. destruct ds as [| d [|]]; try discriminate. now exists d. }
  assert (same : forall w, In w (increasing [a; b; c]) <-> In w [a; b; c])
    by (intro; apply in_increasing).
  rewrite e, face_covers, <- (covers_same B _ _ same) by exact n. split; [apply h2 |].
  intro h. apply covers_iff in h as (t & j & s). apply h1 in j as k.
  apply any_exists in k as (f & jf & s'). replace (increasing [a; b; c]) with f; auto.
  assert (jf' : In f (faces 3)) by now apply filter_In in jf.
  pose proof (face_nodup 3 f ltac:(lia) jf') as [nf lf].
  pose proof (face_nodup 3 _ ltac:(lia) i) as [ni li].
  assert (p : forall g, NoDup g -> length g = 3 -> subset g (corners t) = true ->
    forall v, In v g <-> In v (corners t)).
  { intros g ng lg sg v. pose proof (permutation_subset g (corners t) ng) as p.
    rewrite length_corners, lg in p. specialize (p (le_n 3) sg).
    split; apply Permutation_in; auto using Permutation_sym. }
  assert (canonical : forall g, In g (faces 3) -> increasing g = g).
  { apply (map_ext_in_iff (f := increasing) (g := fun g => g)). vm_compute. reflexivity. }
  rewrite <- (canonical f jf'), <- (canonical _ i). unfold increasing at 1 2. apply filter_ext.
  intro v. apply eq_true_iff_eq. rewrite !mem_iff, (p f nf lf s'), (p _ ni li s). tauto.
Qed.
End Test.

Theorem triangulates_sound T : triangulates T = true -> triangulation T.
Proof.
  unfold triangulates. cbv zeta. rewrite !lazy_and. intros (ok & tr & ed & ve & b).
  apply any_exists in b as (B & i & b). exists B. split; auto. constructor.
  - intros t j. split; [now apply (tested_nodup T ok) |]. intros f jf p.
    unfold proper_test in ok. rewrite every_forall in ok. apply ok, lazy_and in j as [_ j].
    rewrite every_forall in j. apply j, negb_true_iff, not_true_iff_false in jf. apply jf.
    apply subset_iff. intro v. now apply Permutation_in.
  - intros a b' c n. destruct (apexes_tested T ok a b' c n) as (ds & ap & len). exists ds.
    split; auto. rewrite len. apply Nat.leb_le. unfold triangles_test in tr.
    rewrite every_forall in tr. now apply tr, increasing_face.
  - now apply boundary_sound.
  - intros a b' ne. rewrite every_forall in ed.
    assert (n : NoDup [a; b']) by (repeat constructor; simpl; intuition).
    pose proof (increasing_face _ n) as k. pose proof (increasing_permutation _ n) as p.
    apply ed in k. revert k p. destruct (increasing [a; b']) as [| x [| y [|]]]; try discriminate.
    intros k p. apply (edge_sound T ok) in k.
    apply Permutation_length_2 in p as [[<- <-] | [<- <-]]; auto.
    now apply edge_swap.
  - intro v. apply (vertex_sound T ok). rewrite every_forall in ve. apply ve, in_all_vertices.
Qed.

(** ** Telling triangulations apart

    A set of tetrahedra is coded as one number, with a bit for each quadruple. The orbit of T has
    the codes of its images under the 48 symmetries. *)

Definition mask (f : list vertex) : positive := bits (map (fun v => mem v f) all_vertices).
Definition masks : list positive := Eval vm_compute in map mask (faces 4).
Definition code (T : list tetrahedron) : positive :=
  let those := map (fun t => mask (vertices t)) T in
  bits (map (fun m => any (Pos.eqb m) those) masks).
Definition orbit (T : list tetrahedron) : list positive :=
  map (fun l => code (map (relabel (at_list l)) T)) symmetries.

Lemma code_same T U : (forall a b c d, spans T a b c d <-> spans U a b c d) -> code T = code U.
Proof.
  assert (one : forall T U, (forall a b c d, spans T a b c d -> spans U a b c d) ->
    incl (map (fun t => mask (vertices t)) T) (map (fun t => mask (vertices t)) U)).
  { clear T U. intros T U h m i. apply in_map_iff in i as ([[[a b] c] d] & <- & i).
    destruct (h a b c d) as (u & j & p); [exists (a, b, c, d); auto |].
    apply in_map_iff. exists u. split; auto. unfold mask. f_equal. apply map_ext. intro v.
    apply eq_true_iff_eq. rewrite !mem_iff.
    split; apply Permutation_in; auto using Permutation_sym. }
  intro h. unfold code. cbv zeta. f_equal. apply map_ext. intro m.
  apply eq_true_iff_eq. rewrite !any_exists.
  split; intros (x & i & e); exists x; split; auto; revert i; apply one; intros; now apply h.
Qed.
Theorem orbit_complete T U : equivalent T U -> In (code U) (orbit T).
Proof.
  intros (s & sym & h). unfold orbit. apply in_map_iff. exists (map s all_vertices).
  split; [| now apply symmetry_listed]. destruct (inverse s sym) as (r & _ & undo & undo').
  apply code_same. intros a b c d.
  assert (e : map (relabel (at_list (map s all_vertices))) T = map (relabel s) T).
  { apply map_ext. intros [[[x y] z] w]. unfold relabel. now rewrite !at_list_map. }
  rewrite e, <- (undo' a), <- (undo' b), <- (undo' c), <- (undo' d), (spans_relabel s r undo).
  apply h.
Qed.

(** In a list, the code of none is in the orbit of an earlier one. *)
Definition all_differ (Ts : list (list tetrahedron)) : bool :=
  all_pairs (fun x y : list positive * positive => negb (any (Pos.eqb (snd y)) (fst x)))
    (map (fun T => (orbit T, code T)) Ts).
Lemma all_pairs_map A C (h : A -> C) f l :
  all_pairs f (map h l) = all_pairs (fun x y => f (h x) (h y)) l.
Proof.
  induction l as [| x l IH]; simpl; auto. rewrite IH. f_equal. clear IH.
  induction l; simpl; congruence.
Qed.
Lemma all_differ_nodup A (of : A -> list tetrahedron) l : all_differ (map of l) = true -> NoDup l.
Proof.
  unfold all_differ. rewrite !all_pairs_map. cbn [fst snd].
  induction l as [| x l IH]; [constructor |]. cbn [all_pairs]. rewrite andb_true_iff, forallb_forall.
  intros [h1 h2]. constructor; auto. intro i. apply h1, negb_true_iff, not_true_iff_false in i.
  apply i, any_exists. exists (code (of x)). split; [| apply Pos.eqb_refl].
  apply orbit_complete, equivalent_refl.
Qed.
Lemma all_differ_sound A (of : A -> list tetrahedron) l : all_differ (map of l) = true ->
  forall x y, In x l -> In y l -> equivalent (of x) (of y) -> x = y.
Proof.
  unfold all_differ. rewrite !all_pairs_map. cbn [fst snd]. intros h x y ix iy e.
  assert (no : forall T U, negb (any (Pos.eqb (code U)) (orbit T)) = true -> ~ equivalent T U).
  { clear. intros T U h e. apply negb_true_iff, not_true_iff_false in h. apply h, any_exists.
    exists (code U). split; [now apply orbit_complete | apply Pos.eqb_refl]. }
  destruct (all_pairs_sound _ _ _ h x y ix iy) as [k | [k | k]]; auto; apply no in k; exfalso; auto.
  apply k, equivalent_sym, e.
Qed.
