(** * 143 patterns carry a valid hexahedron

    at the integer points of the certificates, over every ordered field. *)

From Coq Require Import List Bool ZArith.
From Certify Require Import Definitions Integral Jacobian Pattern.
From Certify Require Import Catalogue Points_valid.

Lemma valid_tested :
  all_two (fun x q => realizes_test (place q) (tetrahedra x) &&
      not_mirrored_test (place q) (tetrahedra x) && positive_jacobian_test (place q))
    (filter (fun x => is_yes (claimed_valid x)) catalogue) valid_points = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem valid_yes x : In x catalogue -> claimed_valid x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K, valid (tetrahedra x) p.
Proof.
  intros i e K. destruct (all_two_sound _ _ _ _ _ valid_tested x) as [q h].
  - apply filter_In. now rewrite e.
  - rewrite !andb_true_iff in h. destruct h as [[h1 h2] h3]. exists (imaged (place q)).
    assert (real : realizes (tetrahedra x) (imaged (K := K) (place q))) by now apply realizes_test_sound.
    constructor; auto.
    + apply not_mirrored_test_sound; auto. apply real.
    + now apply positive_jacobian_test_sound.
Qed.
