(** * 31 patterns carry no valid hexahedron

    The proofs refute the formula with the clauses "corners" and "edges" and, for 15_G, that of a final
    polynomial; for fifteen patterns also with the clauses "separations". These last ones hold over
    fields with intermediate values of cubic polynomials.

    Where the Python kernel's refutation rests on its family "sections", that is, on the fact that a
    plane section of an embedded ball is a disc, another proof is taken, from the folder
    formal/proofs/. *)

From Coq Require Import List Bool Permutation.
From Certify Require Import Definitions Barycentric Lrat Integral Pattern Formula Signs Polynomials.
From Certify Require Import Jacobian Separation.
From Certify Require Import Catalogue Refutations_valid.
Import ListNotations.

(** ** The sign of the first tetrahedron

    It lies at a triangle of a facet, and a valid hexahedron is not mirrored. *)

Lemma sorted_members q v : In v (vertices (fst (sorted q))) <-> In v (vertices q).
Proof.
  destruct q as [[[a b] c] d]. unfold sorted.
  repeat match goal with |- context [if exchange ?x ?y then _ else _] => destruct (exchange x y) end;
    simpl; tauto.
Qed.
(** Are the first three vertices of [q] a boundary triangle, of the tetrahedron [t] alone? *)
Definition at_boundary (T : list tetrahedron) (q t : tetrahedron) : bool :=
  let '(a, b, c, _) := q in
  existsb (fun f => let '(x, y, z) := f in same_vertex a x && same_vertex b y && same_vertex c z)
    facet_triangles &&
  forallb (fun u => negb (contains u [a; b; c]) || same_tetrahedron u t) T.
Definition starts_at_boundary (T : list tetrahedron) (start : option tetrahedron) : bool :=
  match start with Some q => at_boundary T q (fst (sorted q)) | None => false end.

Lemma positive_at_boundary (K : ordered_field) (p : vertex -> point K) T q t :
  not_mirrored T p -> at_boundary T q t = true -> In t T ->
  volume p q <> zero -> volume p t <> zero -> (forall v, In v (vertices t) <-> In v (vertices q)) ->
  has p true q true.
Proof.
  destruct q as [[[a b] c] d]. unfold at_boundary. intros side h i nq nt same.
  apply andb_true_iff in h as [h only]. rewrite forallb_forall in only.
  apply existsb_exists in h as ([[x y] z] & facet & h).
  rewrite !andb_true_iff, !same_vertex_iff in h. destruct h as [[-> ->] ->].
  apply (side t x y z d i facet).
  - apply NoDup_Permutation.
    + exact (volume_nodup K p _ nq).
    + exact (volume_nodup K p _ nt).
    + intro v. symmetry. apply same.
  - intros u iu ic. apply contains_iff in ic. specialize (only u iu). rewrite ic in only.
    now apply same_tetrahedron_eq in only as ->.
Qed.
Lemma first_positive (K : ordered_field) (p : vertex -> point K) T : realizes T p -> not_mirrored T p ->
  starts_at_boundary T (first T) = true -> forall q, first T = Some q -> has p true q true.
Proof.
  intros real side h q e. rewrite e in h. cbn [starts_at_boundary] in h. apply first_in in e.
  apply (positive_at_boundary K p T q _ side h e).
  - now apply (sorted_not_degenerate K p T).
  - exact (not_degenerate _ _ real _ e).
  - apply sorted_members.
Qed.

(** ** The replay *)

Lemma not_valid_tested :
  let db := axioms_loaded in
  all_two (fun x r =>
      starts_at_boundary (tetrahedra x) (first (tetrahedra x)) &&
      refuted_with (corners ++ edges ++
        (if needs_intermediate_values x then separations else polynomial_clauses (fst r)))
        db (tetrahedra x) (snd r))
    (filter (fun x => is_no (claimed_valid x)) catalogue) valid_refutations = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem valid_no x : In x catalogue -> claimed_valid x = No ->
  forall K : ordered_field, cubic_intermediate_values K \/ needs_intermediate_values x = false ->
  forall p : vertex -> point K, ~ valid (tetrahedra x) p.
Proof.
  intros i e K enough p [real side jac]. destruct (all_two_sound _ _ _ _ _ not_valid_tested x) as [r h].
  - apply filter_In. now rewrite e.
  - apply andb_true_iff in h as [hf h].
    pose proof (first_positive K p _ real side hf) as first_pos.
    apply (refuted_with_sound K p true _ real _ _ first_pos) in h; auto.
    intros c ic. rewrite !in_app_iff in ic. destruct ic as [ic | [ic | ic]].
    + now apply corners_sound.
    + now apply edges_sound.
    + destruct (needs_intermediate_values x).
      * destruct enough as [cubic | no]; [| discriminate]. now apply (separations_sound K cubic).
      * now apply (polynomial_clauses_sound K p true (fst r)).
Qed.
