(** * The 48 symmetries

    They are listed ([symmetry_listed]); they form a group, so that [equivalent] is an equivalence;
    and a relabelled triangulation is a triangulation ([carry]). *)

From Coq Require Import List Bool Permutation PeanoNat Lia.
From Certify Require Import Barycentric Integral Faces Links.
Import ListNotations.

(** ** The list *)

(** Lists of n different vertices. *)
Fixpoint injections (n : nat) : list (list vertex) :=
  match n with
  | 0 => [[]]
  | S n' =>
      flat_map (fun l => map (fun v => v :: l) (filter (fun v => negb (mem v l)) all_vertices))
        (injections n')
  end.
Lemma in_injections l : NoDup l -> In l (injections (length l)).
Proof.
  induction 1 as [| v l n h IH]; [now left |]. cbn [injections length].
  apply in_flat_map. exists l. split; auto.
  apply in_map_iff. exists v. split; auto. apply filter_In.
  split; [apply in_all_vertices |]. now apply negb_true_iff, mem_false.
Qed.

(** The map that a list of eight vertices stands for. *)
Definition at_list (l : list vertex) (v : vertex) : vertex :=
  match l with
  | [v1; v2; v3; v4; v5; v6; v7; v8] =>
      match v with V1 => v1 | V2 => v2 | V3 => v3 | V4 => v4
                 | V5 => v5 | V6 => v6 | V7 => v7 | V8 => v8 end
  | _ => v
  end.
Lemma at_list_map s v : at_list (map s all_vertices) v = s v.
Proof. now destruct v. Qed.

Definition takes_facets (s : vertex -> vertex) : bool :=
  every (fun f => any (fun g => subset (map s (vertices f)) (vertices g)) facets) facets.
Definition symmetries : list (list vertex) :=
  Eval vm_compute in filter (fun l => takes_facets (at_list l)) (injections 8).

Lemma symmetries_are : symmetries = filter (fun l => takes_facets (at_list l)) (injections 8).
Proof. vm_cast_no_check (eq_refl symmetries). Qed.
Lemma symmetries_48 : length symmetries = 48.
Proof. reflexivity. Qed.

Lemma takes_facets_ext s r : (forall v, s v = r v) -> takes_facets s = takes_facets r.
Proof.
  intro h. unfold takes_facets. generalize facets at 2 4. intro l.
  induction l as [| f l IH]; cbn [every]; auto. now rewrite IH, (map_ext s r h).
Qed.
Theorem symmetry_listed s : symmetry s -> In (map s all_vertices) symmetries.
Proof.
  intros [inj h]. rewrite symmetries_are. apply filter_In. split.
  - apply in_injections, FinFun.Injective_map_NoDup; [exact inj | apply all_vertices_nodup].
  - rewrite (takes_facets_ext _ s) by apply at_list_map. apply every_forall. intros f i.
    destruct (h f i) as (g & j & p). apply any_exists. exists g. split; auto.
    apply subset_iff. intro v. now apply Permutation_in.
Qed.

(** Each of them takes facets to facets, and another one undoes it. *)
Lemma symmetries_sound l : In l symmetries -> exists m, In m symmetries /\
  (forall v, at_list m (at_list l v) = v) /\ takes_facets (at_list l) = true.
Proof.
  assert (k : every (fun l => any (fun m =>
    every (fun v => same_vertex (at_list m (at_list l v)) v) all_vertices) symmetries &&
      takes_facets (at_list l)) symmetries = true) by (vm_compute; reflexivity).
  rewrite every_forall in k. intro i. apply k in i. apply andb_true_iff in i as [i t].
  apply any_exists in i as (m & j & h). exists m. repeat split; auto. intro v.
  rewrite every_forall in h. apply same_vertex_iff, h, in_all_vertices.
Qed.
Lemma listed_symmetry l : In l symmetries -> symmetry (at_list l).
Proof.
  intro i. destruct (symmetries_sound l i) as (m & _ & u & h).
  assert (inj : forall v w, at_list l v = at_list l w -> v = w).
  { intros v w e. now rewrite <- (u v), <- (u w), e. }
  split; auto. intros f j. assert (d : NoDup (map (at_list l) (vertices f))).
  { apply FinFun.Injective_map_NoDup; [exact inj |]. now apply facet_nodup. }
  unfold takes_facets in h. rewrite every_forall in h. apply h in j.
  apply any_exists in j as (g & j & s). exists g. split; auto.
  apply permutation_subset; auto. now rewrite map_length, !length_vertices.
Qed.
Theorem inverse s : symmetry s ->
  exists r, symmetry r /\ (forall v, r (s v) = v) /\ (forall v, s (r v) = v).
Proof.
  intro h. pose proof (symmetry_listed s h) as i.
  destruct (symmetries_sound _ i) as (m & j & u & _). pose proof (listed_symmetry m j) as k.
  exists (at_list m). split; auto.
  assert (e : forall v, at_list m (s v) = v) by (intro v; now rewrite <- (at_list_map s v)).
  split; auto. intro v. apply (proj1 k). now rewrite e.
Qed.

(** ** [equivalent] is an equivalence *)

Theorem equivalent_refl T : equivalent T T.
Proof.
  exists (fun v => v). split; [| tauto]. split; auto. intros f i. exists f. split; auto.
  now rewrite map_id.
Qed.
Theorem equivalent_sym T U : equivalent T U -> equivalent U T.
Proof.
  intros (s & h & k). destruct (inverse s h) as (r & h' & e & e'). exists r. split; auto.
  intros a b c d. rewrite k, !e'. tauto.
Qed.
Theorem equivalent_trans T U W : equivalent T U -> equivalent U W -> equivalent T W.
Proof.
  intros (s & [i h] & k) (r & [i' h'] & k'). exists (fun v => r (s v)). split; [split |].
  - auto.
  - intros f j. destruct (h f j) as (g & jg & p), (h' g jg) as (g' & jg' & p').
    exists g'. split; auto. rewrite <- map_map. apply (Permutation_map r) in p.
    eauto using Permutation_trans.
  - intros. now rewrite k, k'.
Qed.

(** ** Relabelled triangulations *)

Lemma map_undo (s r : vertex -> vertex) l : (forall v, r (s v) = v) -> map r (map s l) = l.
Proof. intro h. rewrite map_map, <- map_id. apply map_ext, h. Qed.

Definition relabel_triangle (s : vertex -> vertex) (t : triangle) : triangle :=
  let '(a, b, c) := t in (s a, s b, s c).
Definition relabel (s : vertex -> vertex) (t : tetrahedron) : tetrahedron :=
  let '(a, b, c, d) := t in (s a, s b, s c, s d).
Lemma corners_relabel s t : corners (relabel_triangle s t) = map s (corners t).
Proof. now destruct t as [[a b] c]. Qed.
Lemma vertices_relabel s t : vertices (relabel s t) = map s (vertices t).
Proof. now destruct t as [[[a b] c] d]. Qed.

Section Inverse.
Variables s r : vertex -> vertex.
Hypothesis undo : forall v, r (s v) = v.

Lemma injective u v : s u = s v -> u = v.
Proof. intro e. now rewrite <- (undo u), <- (undo v), e. Qed.
Lemma map_nodup l : NoDup (map s l) <-> NoDup l.
Proof.
  split; [apply NoDup_map_inv | apply FinFun.Injective_map_NoDup; exact injective].
Qed.
Lemma map_permutation l m : Permutation (map s l) (map s m) <-> Permutation l m.
Proof.
  split; [| apply Permutation_map].
  intro p. apply (Permutation_map r) in p. now rewrite !map_undo in p.
Qed.
Lemma spans_relabel T a b c d :
  spans (map (relabel s) T) (s a) (s b) (s c) (s d) <-> spans T a b c d.
Proof.
  unfold spans. split.
  - intros (t & i & p). apply in_map_iff in i as (u & <- & i). exists u. split; auto.
    rewrite vertices_relabel in p. now apply (map_permutation [a; b; c; d]).
  - intros (t & i & p). exists (relabel s t). split; [now apply in_map |].
    rewrite vertices_relabel. now apply (map_permutation [a; b; c; d]).
Qed.
Lemma face_relabel D a b c :
  face (map (relabel_triangle s) D) (s a) (s b) (s c) <-> face D a b c.
Proof.
  unfold face. split.
  - intros (t & i & p). apply in_map_iff in i as (u & <- & i). exists u. split; auto.
    rewrite corners_relabel in p. now apply (map_permutation [a; b; c]).
  - intros (t & i & p). exists (relabel_triangle s t). split; [now apply in_map |].
    rewrite corners_relabel. now apply (map_permutation [a; b; c]).
Qed.
Lemma consecutive_map l x y : consecutive (map s l) (s x) (s y) <-> consecutive l x y.
Proof.
  split.
  - intros (before & after & e). exists (map r before), (map r after).
    apply (f_equal (map r)) in e. rewrite map_undo, map_app in e by exact undo. simpl in e.
    now rewrite !undo in e.
  - intros (before & after & ->). exists (map s before), (map s after). now rewrite map_app.
Qed.
Lemma neighbours_map l x y : neighbours (map s l) (s x) (s y) <-> neighbours l x y.
Proof. unfold neighbours. now rewrite !consecutive_map. Qed.

Hypothesis undo' : forall v, s (r v) = v.

Lemma rim_map D a b : rim D a b -> rim (map (relabel_triangle s) D) (s a) (s b).
Proof.
  intros (c & h & u). exists (s c). split; [now apply face_relabel |].
  intros d k. rewrite <- (undo' d) in *. f_equal. apply u. now apply face_relabel.
Qed.
Lemma edge_map D a b : edge (map (relabel_triangle s) D) (s a) (s b) -> edge D a b.
Proof. intros (c & h). exists (r c). rewrite <- (undo' c) in h. now apply face_relabel. Qed.
Lemma has_vertex_map D a :
  has_vertex (map (relabel_triangle s) D) (s a) -> has_vertex D a.
Proof. intros (b & h). exists (r b). rewrite <- (undo' b) in h. now apply edge_map. Qed.
Lemma disc_map D : disc D -> disc (map (relabel_triangle s) D).
Proof.
  induction 1 as [a b c n | D a b c d IH h k | D a b c d IH h h' ne k]; simpl.
  - constructor. now apply (map_nodup [a; b; c]).
  - apply glue_one_edge; auto using rim_map. intro j. now apply k, has_vertex_map.
  - apply glue_two_edges; auto using rim_map.
    + intro e. apply ne, injective, e.
    + intro j. now apply k, edge_map.
Qed.

Variables T U : list tetrahedron.
Hypothesis same : forall a b c d, spans T a b c d <-> spans U (s a) (s b) (s c) (s d).

Lemma apexes_carried a b c ds : apexes T a b c ds -> apexes U (s a) (s b) (s c) (map s ds).
Proof.
  intros [n h]. split; [now apply map_nodup |]. intro d. rewrite <- (undo' d), <- same, <- h.
  rewrite in_map_iff. split; [intros (e & k & i); now apply injective in k as -> |].
  intro i. now exists (r d).
Qed.
Lemma path_carried a b : path (spans T a b) -> path (spans U (s a) (s b)).
Proof.
  intros (l & n & h). exists (map s l). split; [now apply map_nodup |]. intros x y.
  now rewrite <- (undo' x), <- (undo' y), <- same, neighbours_map.
Qed.
Lemma cycle_carried a b : cycle (spans T a b) -> cycle (spans U (s a) (s b)).
Proof.
  intros (v & l & n & k & h). exists (s v), (map s l). split; [| split].
  - now apply (map_nodup (v :: l)).
  - now rewrite map_length.
  - intros x y. rewrite <- (undo' x), <- (undo' y), <- same, h, <- neighbours_map.
    simpl. rewrite map_app. reflexivity.
Qed.
End Inverse.

Theorem carry s B C T U : symmetry s ->
  (forall a b c d, spans T a b c d <-> spans U (s a) (s b) (s c) (s d)) ->
  (forall a b c, NoDup [a; b; c] -> (face B a b c <-> face C (s a) (s b) (s c))) ->
  bounded_by B T -> bounded_by C U.
Proof.
  intros sym same same' tri. destruct (inverse s sym) as (r & sym' & undo & undo').
  assert (back : forall a b c d, spans U a b c d <-> spans T (r a) (r b) (r c) (r d)).
  { intros. rewrite same, !undo'. tauto. }
  constructor.
  - intros t i.
    assert (p : exists u, In u T /\ Permutation (map r (vertices t)) (vertices u)).
    { destruct t as [[[a b] c] d]. apply back. now exists (a, b, c, d). }
    destruct p as (u & j & p). destruct (proper B T tri u j) as [n k]. split.
    + apply Permutation_sym in p. apply (Permutation_NoDup p) in n. now apply NoDup_map_inv in n.
    + intros f jf q. destruct sym' as [_ sym']. destruct (sym' f jf) as (g & jg & q').
      apply (k g jg). apply (Permutation_map r) in q.
      eauto using Permutation_trans, Permutation_sym.
  - intros a b c n. rewrite <- (undo' a), <- (undo' b), <- (undo' c) in *.
    apply (map_nodup s r undo [r a; r b; r c]) in n.
    destruct (at_most_two B T tri _ _ _ n) as (ds & h & le). exists (map s ds).
    rewrite map_length. split; auto. now apply (apexes_carried s r undo undo' T U).
  - intros a b c n. rewrite <- (undo' a), <- (undo' b), <- (undo' c) in n |- *.
    apply (map_nodup s r undo [r a; r b; r c]) in n.
    rewrite <- same', <- (boundary B T tri) by exact n. split.
    + intros (d & h). apply (apexes_carried r s undo' undo U T back) in h.
      rewrite !undo in h. now exists (r d).
    + intros (d & h). exists (s d). now apply (apexes_carried s r undo undo' T U same _ _ _ [d]).
  - intros a b ne. rewrite <- (undo' a), <- (undo' b).
    destruct (edge_links B T tri (r a) (r b)) as [h | h].
    + intro e. apply ne. now rewrite <- (undo' a), <- (undo' b), e.
    + left. now apply (path_carried s r undo undo' T U).
    + right. now apply (cycle_carried s r undo undo' T U).
  - intro v. destruct (vertex_links B T tri (r v)) as (D & d & h).
    exists (map (relabel_triangle s) D). split; [now apply (disc_map s r) |]. intros a b c.
    rewrite <- (undo' a), <- (undo' b), <- (undo' c), <- (undo' v).
    now rewrite (face_relabel s r undo), h, same.
Qed.
