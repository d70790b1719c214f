(** * 171 patterns are realized, and 158 with all vertices extreme

    by the integer points of the certificates, over every ordered field. *)

From Coq Require Import List Bool ZArith.
From Certify Require Import Definitions Integral Pattern.
From Certify Require Import Catalogue Points_realizable Points_convex.

Lemma realizable_tested :
  all_two (fun x q => realizes_test (place q) (tetrahedra x))
    (filter (fun x => is_yes (claimed_realizable x)) catalogue) realizable_points = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Lemma convex_tested :
  all_two (fun x q => realizes_test (place q) (tetrahedra x) && convex_test (place q))
    (filter (fun x => is_yes (claimed_convex x)) catalogue) convex_points = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem realizable_yes x : In x catalogue -> claimed_realizable x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K, realizes (tetrahedra x) p.
Proof.
  intros i e K. destruct (all_two_sound _ _ _ _ _ realizable_tested x) as [q h].
  - apply filter_In. now rewrite e.
  - exists (imaged (place q)). now apply realizes_test_sound.
Qed.

Theorem convex_yes x : In x catalogue -> claimed_convex x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K,
    realizes (tetrahedra x) p /\ convex_position p.
Proof.
  intros i e K. destruct (all_two_sound _ _ _ _ _ convex_tested x) as [q h].
  - apply filter_In. now rewrite e.
  - apply andb_true_iff in h as [h1 h2]. exists (imaged (place q)).
    split; [now apply realizes_test_sound | now apply convex_test_sound].
Qed.
