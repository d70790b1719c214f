(** * The rational numbers are an ordered field

    So every theorem for every ordered field holds for rational points. (Coq's own real numbers rest
    on axioms and are left out; any construction of the reals that satisfies the laws of Field.v is
    covered.) *)

From Coq Require Import QArith Qcanon.
From Certify Require Import Field.

Lemma Qc_lt_total (x y : Qc) : (x < y \/ x = y \/ y < x)%Qc.
Proof.
  destruct (Qc_dec x y) as [[h | h] | h]; auto.
Qed.
Lemma Qc_lt_add (x y z : Qc) : (x < y -> x + z < y + z)%Qc.
Proof.
  unfold Qclt. intro h.
  assert (e : forall a : Qc, (this (a + z)%Qc == this a + this z)%Q) by (intro a; apply Qred_correct).
  rewrite !e. apply Qplus_lt_le_compat; auto. apply Qle_refl.
Qed.
Lemma Qc_lt_mul (x y : Qc) : (0 < x -> 0 < y -> 0 < x * y)%Qc.
Proof.
  intros hx hy. replace 0%Qc with (0 * y)%Qc by ring. now apply Qcmult_lt_compat_r.
Qed.
Lemma Qc_add_opp (x : Qc) : (x + - x = 0)%Qc.
Proof. ring. Qed.

Definition rationals : ordered_field :=
  OrderedField Qc 0%Qc 1%Qc Qcplus Qcmult Qcopp Qcinv Qclt
    Qcplus_comm Qcplus_assoc Qcplus_0_l Qc_add_opp
    Qcmult_comm Qcmult_assoc Qcmult_1_l Qcmult_plus_distr_l Qcmult_inv_r
    (fun x h => Qclt_not_eq x x h eq_refl) Qclt_trans Qc_lt_total Qc_lt_add Qc_lt_mul eq_refl.
