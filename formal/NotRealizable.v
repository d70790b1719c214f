(** * Three patterns are realized by no points

    15_A, 15_B and 15_J: the proofs in proofs/ refute the formulas of these patterns. *)

From Coq Require Import List Bool.
From Certify Require Import Definitions Lrat Integral Pattern Formula Signs Polynomials.
From Certify Require Import Catalogue Refutations_realizable.

Lemma not_realizable_tested :
  let db := axioms_loaded in
  all_two (fun x r => refuted_with (polynomial_clauses (fst r)) db (tetrahedra x) (snd r))
    (filter (fun x => is_no (claimed_realizable x)) catalogue) realizable_refutations = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem realizable_no x : In x catalogue -> claimed_realizable x = No ->
  forall (K : ordered_field) (p : vertex -> point K), ~ realizes (tetrahedra x) p.
Proof.
  intros i e K p real. destruct (all_two_sound _ _ _ _ _ not_realizable_tested x) as [r h].
  - apply filter_In. now rewrite e.
  - destruct (some_sign K p _ real) as [g hg].
    apply (refuted_with_sound K p g _ real _ _ hg) in h; auto.
    now apply polynomial_clauses_sound.
Qed.
