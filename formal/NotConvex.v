(** * Thirteen realizable patterns, and the three others, have no convex position

    In every realization some vertex lies inside a tetrahedron of others. *)

From Coq Require Import List Bool.
From Certify Require Import Definitions Lrat Integral Pattern Formula Signs Polynomials Convex.
From Certify Require Import Catalogue Refutations_convex.

Lemma not_convex_tested :
  let db := axioms_loaded in
  all_two (fun x r => refuted_with (on_hulls ++ polynomial_clauses (fst r)) db (tetrahedra x) (snd r))
    (filter (fun x => is_no (claimed_convex x)) catalogue) convex_refutations = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem convex_no x : In x catalogue -> claimed_convex x = No ->
  forall (K : ordered_field) (p : vertex -> point K), realizes (tetrahedra x) p ->
    exists v, inside p v.
Proof.
  intros i e K p real. destruct (all_two_sound _ _ _ _ _ not_convex_tested x) as [r h].
  - apply filter_In. now rewrite e.
  - destruct (some_sign K p _ real) as [g hg]. now apply (not_convex_sound K p g (tetrahedra x) (fst r) (snd r)).
Qed.
