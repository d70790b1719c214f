(** * The theorems

    Each is stated in the words of Definitions.v and Pattern.v, and one with the ordered field
    [rationals] of Rationals.v; the tetrahedra are those of the module Catalogue, which lists what
    the folder certificates/ says. At the end Coq prints the theorems, and the axioms on which they
    rest: there are none. *)

From Certify Require Import Realizable NotRealizable Convex NotConvex Valid NotValid.
(* These come last, so that the words in the statements are theirs, whatever others define. *)
From Coq Require Import List String Bool PeanoNat.
From Certify Require Import Catalogue Rationals Pattern Definitions.
Import ListNotations.

Definition count (test : pattern -> bool) : nat := List.length (filter test catalogue).

(** How many with 5, 6, ..., 15 tetrahedra? *)
Definition row (test : pattern -> bool) : list nat :=
  map (fun n => count (fun x => (List.length (tetrahedra x) =? n) && test x)) (seq 5 11).

(** The catalogue has 174 patterns with different names; so many are claimed to be realizable, to
    be so in convex position, and to carry a valid hexahedron; and the others not to. *)
Theorem catalogue_counts :
  List.length catalogue = 174 /\ NoDup (map name catalogue) /\
  map name (filter (fun x => is_no (claimed_realizable x)) catalogue) =
    ["15_A"; "15_B"; "15_J"]%string /\
  row (fun _ => true) = [1; 5; 5; 7; 13; 20; 35; 30; 28; 19; 11] /\
  row (fun x => is_yes (claimed_realizable x)) = [1; 5; 5; 7; 13; 20; 35; 30; 28; 19; 8] /\
  row (fun x => is_yes (claimed_convex x)) = [1; 5; 5; 7; 13; 20; 35; 28; 26; 14; 4] /\
  row (fun x => is_yes (claimed_valid x)) = [1; 5; 5; 7; 13; 20; 33; 24; 20; 12; 3] /\
  count (fun x => is_yes (claimed_realizable x)) = 171 /\
  count (fun x => is_no (claimed_realizable x)) = 3 /\
  count (fun x => is_yes (claimed_convex x)) = 158 /\
  count (fun x => is_no (claimed_convex x)) = 16 /\
  count (fun x => is_yes (claimed_realizable x) && is_no (claimed_convex x)) = 13 /\
  count (fun x => is_yes (claimed_valid x)) = 143 /\
  count (fun x => is_no (claimed_valid x)) = 31 /\
  count (fun x => is_no (claimed_valid x) && negb (needs_intermediate_values x)) = 16.
Proof.
  repeat match goal with |- _ /\ _ => split end; try (vm_compute; reflexivity).
  assert (e : nodup string_dec (map name catalogue) = map name catalogue) by (vm_compute; reflexivity).
  rewrite <- e. apply NoDup_nodup.
Qed.

(** ** Realizable *)

Theorem realizable_171 : forall x, In x catalogue -> claimed_realizable x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K, realizes (tetrahedra x) p.
Proof. exact realizable_yes. Qed.

Theorem not_realizable_3 : forall x, In x catalogue -> claimed_realizable x = No ->
  forall (K : ordered_field) (p : vertex -> point K), ~ realizes (tetrahedra x) p.
Proof. exact realizable_no. Qed.

(** ** Convex position *)

Theorem convex_158 : forall x, In x catalogue -> claimed_convex x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K,
    realizes (tetrahedra x) p /\ convex_position p.
Proof. exact convex_yes. Qed.

(** In every realization of the others some vertex is inside the hull. *)
Theorem not_convex_16 : forall x, In x catalogue -> claimed_convex x = No ->
  forall (K : ordered_field) (p : vertex -> point K), realizes (tetrahedra x) p ->
    exists v, inside p v.
Proof. exact convex_no. Qed.

(** So not all are extreme; nor, what is less, on the boundary of the hull. *)
Theorem not_convex_position : forall x, In x catalogue -> claimed_convex x = No ->
  forall (K : ordered_field) (p : vertex -> point K), realizes (tetrahedra x) p ->
    ~ convex_position p /\ ~ (forall v, on_hull p v).
Proof.
  intros x i e K p real. destruct (convex_no x i e K p real) as [v h]. split; intro all.
  - exact (inside_not_extreme K p v h (all v)).
  - exact (inside_not_on_hull K p v h (all v)).
Qed.

(** ** Valid hexahedra *)

Theorem valid_143 : forall x, In x catalogue -> claimed_valid x = Yes ->
  forall K : ordered_field, exists p : vertex -> point K, valid (tetrahedra x) p.
Proof. exact valid_yes. Qed.

(** The others carry none: sixteen over every ordered field, and all 31 over those in which cubic
    polynomials have intermediate values, such as the real numbers. *)
Theorem not_valid_16 : forall x, In x catalogue -> claimed_valid x = No -> needs_intermediate_values x = false ->
  forall (K : ordered_field) (p : vertex -> point K), ~ valid (tetrahedra x) p.
Proof. intros x i e n K. apply (valid_no x i e K). now right. Qed.

Theorem not_valid_31 : forall x, In x catalogue -> claimed_valid x = No ->
  forall K : ordered_field, cubic_intermediate_values K ->
  forall p : vertex -> point K, ~ valid (tetrahedra x) p.
Proof. intros x i e K cubic. apply (valid_no x i e K). now left. Qed.

(** ** Over the rational numbers *)

Theorem rational_realizability : forall x, In x catalogue ->
  (claimed_realizable x = Yes <->
   exists p : vertex -> point rationals, realizes (tetrahedra x) p).
Proof.
  intros x i. split.
  - intro e. exact (realizable_yes x i e rationals).
  - intros [p real]. destruct (claimed_realizable x) eqn:e; auto.
    + exfalso. exact (realizable_no x i e rationals p real).
    + exfalso. assert (none : forallb (fun y => match claimed_realizable y with Unknown => false | _ => true end)
        catalogue = true) by (vm_compute; reflexivity).
      rewrite forallb_forall in none. specialize (none x i). now rewrite e in none.
Qed.

(** ** Assumptions *)

Check realizable_171.
Print Assumptions realizable_171.
Check not_realizable_3.
Print Assumptions not_realizable_3.
Check convex_158.
Print Assumptions convex_158.
Check not_convex_16.
Print Assumptions not_convex_16.
Check not_convex_position.
Print Assumptions not_convex_position.
Check valid_143.
Print Assumptions valid_143.
Check not_valid_16.
Print Assumptions not_valid_16.
Check not_valid_31.
Print Assumptions not_valid_31.
Check catalogue_counts.
Print Assumptions catalogue_counts.
Check rational_realizability.
Print Assumptions rational_realizability.
