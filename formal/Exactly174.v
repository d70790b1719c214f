(** * There are exactly 174 triangulations of the hexahedron, up to symmetry

    - The 174 of the catalogue are triangulations, no two of them equivalent: by tests that compute.
    - Symmetries carry each of the 64 boundaries to one of seven.
    - Every triangulation with one of the seven boundaries is the image of one of the 174 under a
      symmetry: by the proofs in the folder proofs/, replayed. *)

From Coq Require Import List Bool Permutation.
From Certify Require Import Barycentric Integral Faces Links Lrat Symmetry Completeness Recognition.
From Certify Require Completeness_a Completeness_b Completeness_c Completeness_d Completeness_e
  Completeness_f Completeness_g.
(* These come last, so that the words in the statements are theirs, whatever others define. *)
From Certify Require Import Catalogue Pattern Triangulation.
Import ListNotations.

(** ** The 174 *)

Lemma catalogue_tested : forallb (fun x => triangulates (tetrahedra x)) catalogue = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma catalogue_differs : all_differ (map tetrahedra catalogue) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Lemma catalogue_triangulates x : In x catalogue -> triangulation (tetrahedra x).
Proof.
  intro i. apply triangulates_sound. pose proof catalogue_tested as h.
  rewrite forallb_forall in h. now apply h.
Qed.

(** ** Their images with one of the seven boundaries *)

(** A pattern, by its place in the catalogue, and a symmetry. *)
Definition image (x : nat * list vertex) : list tetrahedron :=
  match nth_error catalogue (fst x) with
  | Some p => map (relabel (at_list (snd x))) (tetrahedra p)
  | None => []
  end.
Definition image_test (x : nat * list vertex) : bool :=
  existsb (equal_faces (snd x)) symmetries &&
  match nth_error catalogue (fst x) with Some _ => true | None => false end.

Lemma relabel_equivalent s T : symmetry s -> equivalent T (map (relabel s) T).
Proof.
  intro h. exists s. split; auto. intros a b c d. destruct (inverse s h) as (r & _ & undo & _).
  now rewrite (spans_relabel s r undo).
Qed.
Lemma image_of x : image_test x = true ->
  exists p, In p catalogue /\ equivalent (tetrahedra p) (image x).
Proof.
  unfold image_test, image. intro h. apply andb_true_iff in h as [s h].
  apply existsb_exists in s as (l & i & e). apply equal_faces_sound in e as ->.
  destruct (nth_error catalogue (fst x)) as [p |] eqn:n; [| discriminate].
  exists p. split; [now apply nth_error_In in n |]. now apply relabel_equivalent, listed_symmetry.
Qed.

(** ** One boundary *)

Section Boundary.
Variable B : list triangle.
Variable images : list (nat * list vertex).
Variable proof : list step.
Hypothesis images_tested : forallb image_test images = true.
Hypothesis closed : closed_surface B = true.
Hypothesis refuted : refutes (numbered B (map image images)) proof = true.

(** Triangulations with the same tetrahedra off the facets have the same tetrahedra. *)
Lemma same_spans T U C D : bounded_by C T -> bounded_by D U ->
  (forall q, In q inner -> used T q = used U q) ->
  forall a b c d, spans T a b c d <-> spans U a b c d.
Proof.
  intros tri tri' h a b c d. rewrite (spans_iff C T tri), (spans_iff D U tri').
  assert (e : NoDup [a; b; c; d] -> used T [a; b; c; d] = used U [a; b; c; d]).
  { intro n. pose proof (increasing_face _ n) as i.
    assert (same : forall v, In v [a; b; c; d] <-> In v (increasing [a; b; c; d]))
      by (intro; symmetry; apply in_increasing).
    rewrite (used_same T _ _ same), (used_same U _ _ same).
    apply eq_true_iff_eq. split; intro u.
    - rewrite <- h; auto. now apply (used_inner C T tri).
    - rewrite h; auto. now apply (used_inner D U tri'). }
  split; intros [n u]; split; auto; [rewrite <- e | rewrite e]; auto.
Qed.

Lemma complete_boundary T : bounded_by B T ->
  exists p, In p catalogue /\ equivalent (tetrahedra p) T.
Proof.
  intro tri. destruct (complete B _ proof closed refuted T tri) as (L & i & h).
  apply in_map_iff in i as (x & <- & i). rewrite forallb_forall in images_tested.
  destruct (image_of x (images_tested x i)) as (p & j & e). exists p. split; auto.
  destruct (catalogue_triangulates p j) as (C & iC & triC).
  assert (triD : exists D, bounded_by D (image x)).
  { destruct e as (s & sym & e). exists (map (relabel_triangle s) C).
    apply (carry s C _ (tetrahedra p)); auto. intros a b c _.
    destruct (inverse s sym) as (r & _ & undo & _). now rewrite (face_relabel s r undo). }
  destruct triD as (D & triD). pose proof (same_spans T (image x) B D tri triD h) as same.
  destruct e as (s & sym & e). exists s. split; auto. intros a b c d. now rewrite same, e.
Qed.
End Boundary.

(** ** The seven *)

Definition seven : list (list triangle) :=
  [Completeness_a.boundary; Completeness_b.boundary; Completeness_c.boundary;
   Completeness_d.boundary; Completeness_e.boundary; Completeness_f.boundary;
   Completeness_g.boundary].

Definition replayed (B : list triangle) (images : list (nat * list vertex)) (proof : list step)
  : bool :=
  forallb image_test images && closed_surface B && refutes (numbered B (map image images)) proof.
Definition settled (B : list triangle) : Prop :=
  forall T, bounded_by B T -> exists p, In p catalogue /\ equivalent (tetrahedra p) T.
Lemma replayed_sound B images proof : replayed B images proof = true -> settled B.
Proof.
  unfold replayed. rewrite !andb_true_iff. intros [[h k] r] T. eauto using complete_boundary.
Qed.

Ltac replay images proof :=
  apply (replayed_sound _ images proof); vm_cast_no_check (eq_refl true).
Lemma settled_a : settled Completeness_a.boundary.
Proof. replay Completeness_a.images Completeness_a.proof. Qed.
Lemma settled_b : settled Completeness_b.boundary.
Proof. replay Completeness_b.images Completeness_b.proof. Qed.
Lemma settled_c : settled Completeness_c.boundary.
Proof. replay Completeness_c.images Completeness_c.proof. Qed.
Lemma settled_d : settled Completeness_d.boundary.
Proof. replay Completeness_d.images Completeness_d.proof. Qed.
Lemma settled_e : settled Completeness_e.boundary.
Proof. replay Completeness_e.images Completeness_e.proof. Qed.
Lemma settled_f : settled Completeness_f.boundary.
Proof. replay Completeness_f.images Completeness_f.proof. Qed.
Lemma settled_g : settled Completeness_g.boundary.
Proof. replay Completeness_g.images Completeness_g.proof. Qed.

Lemma seven_settled B : In B seven -> settled B.
Proof.
  intros [<- | [<- | [<- | [<- | [<- | [<- | [<- | []]]]]]]].
  - exact settled_a.
  - exact settled_b.
  - exact settled_c.
  - exact settled_d.
  - exact settled_e.
  - exact settled_f.
  - exact settled_g.
Qed.

(** ** All 64 *)

Definition within (D E : list triangle) : bool :=
  every (fun t => any (fun u => subset (corners t) (corners u)) E) D.
Definition same_surface (D E : list triangle) : bool := if within D E then within E D else false.
Definition carried (B : list triangle) : bool :=
  any (fun l => any (same_surface (map (relabel_triangle (at_list l)) B)) seven) symmetries.
Lemma all_carried : forallb carried boundaries = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Lemma within_covers D E f : within D E = true -> covers D f = true -> covers E f = true.
Proof.
  unfold within. rewrite every_forall. intros h k. apply covers_iff in k as (t & i & s).
  specialize (h t i). apply any_exists in h as (u & j & s'). apply covers_iff. exists u.
  eauto using subset_trans.
Qed.
Lemma same_surface_face D E a b c : same_surface D E = true -> NoDup [a; b; c] ->
  (face D a b c <-> face E a b c).
Proof.
  intros h n. unfold same_surface in h. destruct (within D E) eqn:e; [| discriminate].
  rewrite !face_covers by exact n. split; now apply within_covers.
Qed.

Theorem every_triangulation T : triangulation T ->
  exists p, In p catalogue /\ equivalent (tetrahedra p) T.
Proof.
  intros (B & i & tri). pose proof all_carried as k. rewrite forallb_forall in k.
  apply k in i. unfold carried in i. apply any_exists in i as (l & il & i).
  apply any_exists in i as (C & iC & same). pose proof (listed_symmetry l il) as sym.
  set (s := at_list l) in *. destruct (inverse s sym) as (r & _ & undo & _).
  assert (inj : forall a b c, NoDup [a; b; c] -> NoDup [s a; s b; s c]).
  { intros a b c. now apply (map_nodup s r undo [a; b; c]). }
  assert (triC : bounded_by C (map (relabel s) T)).
  { apply (carry s B C T); auto.
    - intros. now rewrite (spans_relabel s r undo).
    - intros a b c n. rewrite <- (same_surface_face _ C _ _ _ same) by auto.
      now rewrite (face_relabel s r undo). }
  destruct (seven_settled C iC _ triC) as (p & ip & e). exists p. split; auto.
  eauto using equivalent_trans, equivalent_sym, relabel_equivalent.
Qed.

(** ** The theorem *)

Theorem exactly_174 :
  length catalogue = 174 /\ NoDup catalogue /\
  (forall x, In x catalogue -> triangulation (tetrahedra x)) /\
  (forall x y, In x catalogue -> In y catalogue ->
    equivalent (tetrahedra x) (tetrahedra y) -> x = y) /\
  (forall T, triangulation T -> exists x, In x catalogue /\ equivalent (tetrahedra x) T).
Proof.
  split; [reflexivity |]. split; [| split; [| split]].
  - exact (all_differ_nodup pattern tetrahedra catalogue catalogue_differs).
  - exact catalogue_triangulates.
  - exact (all_differ_sound pattern tetrahedra catalogue catalogue_differs).
  - exact every_triangulation.
Qed.

Check exactly_174.
Print Assumptions exactly_174.
