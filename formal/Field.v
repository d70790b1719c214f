(** * Ordered fields

    All geometry in this folder takes place in K^3, where K is an arbitrary ordered field: the
    rationals, the reals, or anything else that satisfies the laws below. An ordered field is a
    record: a set, its operations, and their laws. A theorem "for every K : ordered_field"
    therefore holds wherever these laws hold, and rests on no axiom.

    The order is a relation, not a function, and a law says that of x < y, x = y, y < x one holds.
    This is all that is ever decided about elements of K; no other case distinction is made. *)

From Coq Require Import Ring.

Record ordered_field : Type := OrderedField {
  carrier :> Type;
  zero : carrier;
  one : carrier;
  add : carrier -> carrier -> carrier;
  mul : carrier -> carrier -> carrier;
  opp : carrier -> carrier;
  inv : carrier -> carrier;
  lt : carrier -> carrier -> Prop;
  add_comm : forall x y, add x y = add y x;
  add_assoc : forall x y z, add x (add y z) = add (add x y) z;
  add_zero : forall x, add zero x = x;
  add_opp : forall x, add x (opp x) = zero;
  mul_comm : forall x y, mul x y = mul y x;
  mul_assoc : forall x y z, mul x (mul y z) = mul (mul x y) z;
  mul_one : forall x, mul one x = x;
  mul_add : forall x y z, mul (add x y) z = add (mul x z) (mul y z);
  mul_inv : forall x, x <> zero -> mul x (inv x) = one;
  lt_irrefl : forall x, ~ lt x x;
  lt_trans : forall x y z, lt x y -> lt y z -> lt x z;
  lt_total : forall x y, lt x y \/ x = y \/ lt y x;
  lt_add : forall x y z, lt x y -> lt (add x z) (add y z);
  lt_mul : forall x y, lt zero x -> lt zero y -> lt zero (mul x y);
  zero_lt_one : lt zero one
}.

Arguments zero {_}.
Arguments one {_}.
Arguments add {_}.
Arguments mul {_}.
Arguments opp {_}.
Arguments inv {_}.
Arguments lt {_}.

Definition le {K : ordered_field} (x y : K) : Prop := lt x y \/ x = y.

Declare Scope K_scope.
Delimit Scope K_scope with K.
Bind Scope K_scope with carrier.
Notation "0" := zero : K_scope.
Notation "1" := one : K_scope.
Infix "+" := add : K_scope.
Infix "*" := mul : K_scope.
Notation "- x" := (opp x) : K_scope.
Notation "x - y" := (add x (opp y)) : K_scope.
Infix "<" := lt : K_scope.
Infix "<=" := le : K_scope.

(** What follows are elementary consequences. With the first of them, the tactic [ring] proves
    identities between polynomials over K. *)

Lemma K_ring (K : ordered_field) :
  ring_theory (zero (o := K)) one add mul (fun x y => add x (opp y)) opp eq.
Proof.
  constructor; intros; try reflexivity.
  - apply add_zero.
  - apply add_comm.
  - apply add_assoc.
  - apply mul_one.
  - apply mul_comm.
  - apply mul_assoc.
  - apply mul_add.
  - apply add_opp.
Qed.

Section Consequences.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Implicit Types x y z : K.

Lemma opp_zero : - (0 : K) = 0.
Proof. ring. Qed.
Lemma opp_opp x : - - x = x.
Proof. ring. Qed.
Lemma sub_zero_eq x y : x - y = 0 -> x = y.
Proof. intro h. replace x with (x - y + y) by ring. rewrite h. ring. Qed.

(** ** Signs *)

Lemma neg_opp_pos x : x < 0 <-> 0 < - x.
Proof.
  split; intro h.
  - apply (lt_add K _ _ (- x)) in h. replace (x - x) with (0 : K) in h by ring.
    now replace (0 - x) with (- x) in h by ring.
  - apply (lt_add K _ _ x) in h. replace (0 + x) with x in h by ring.
    now replace (- x + x) with (0 : K) in h by ring.
Qed.
Lemma lt_sub x y : x < y <-> 0 < y - x.
Proof.
  split; intro h.
  - apply (lt_add K _ _ (- x)) in h. now replace (x - x) with (0 : K) in h by ring.
  - apply (lt_add K _ _ x) in h. replace (0 + x) with x in h by ring.
    now replace (y - x + x) with y in h by ring.
Qed.
Lemma le_sub x y : x <= y <-> 0 <= y - x.
Proof.
  split; intros [h | h].
  - left. now apply -> lt_sub.
  - right. subst. ring.
  - left. now apply <- lt_sub.
  - right. symmetry. apply sub_zero_eq. congruence.
Qed.
Lemma trichotomy x : 0 < x \/ x = 0 \/ 0 < - x.
Proof.
  destruct (lt_total K 0 x) as [h | [h | h]]; auto. right; right. now apply neg_opp_pos.
Qed.
Lemma pos_neq_zero x : 0 < x -> x <> 0.
Proof. intros h e. rewrite e in h. now apply lt_irrefl in h. Qed.

(** ** Sums and products of positive and non-negative elements *)

Lemma pos_add x y : 0 < x -> 0 < y -> 0 < x + y.
Proof.
  intros hx hy. apply lt_trans with y; auto. apply lt_sub. now replace (x + y - y) with x by ring.
Qed.
Lemma pos_nonneg_add x y : 0 < x -> 0 <= y -> 0 < x + y.
Proof.
  intros hx [hy | <-]; [now apply pos_add | now replace (x + 0) with x by ring].
Qed.
Lemma nonneg_pos_add x y : 0 <= x -> 0 < y -> 0 < x + y.
Proof. intros hx hy. rewrite add_comm. now apply pos_nonneg_add. Qed.
Lemma nonneg_add x y : 0 <= x -> 0 <= y -> 0 <= x + y.
Proof.
  intros [hx | <-] hy.
  - left. now apply pos_nonneg_add.
  - now replace (0 + y) with y by ring.
Qed.
Lemma nonneg_mul x y : 0 <= x -> 0 <= y -> 0 <= x * y.
Proof.
  intros [hx | <-] [hy | <-]; [left; now apply lt_mul | right; ring | right; ring | right; ring].
Qed.
Lemma nonneg_refl : 0 <= (0 : K).
Proof. now right. Qed.
Lemma not_pos x : ~ 0 < x <-> 0 <= - x.
Proof.
  split.
  - intro h. destruct (trichotomy x) as [p | [-> | n]].
    + contradiction.
    + right. ring.
    + now left.
  - intros h p. apply (lt_irrefl K 0). replace 0 with (x + - x) at 2 by ring.
    now apply pos_nonneg_add.
Qed.
Lemma pos_not_neg x : 0 < x -> ~ 0 < - x.
Proof. intro h. apply not_pos. replace (- - x) with x by ring. now left. Qed.
Lemma pos_decidable x : 0 < x \/ ~ 0 < x.
Proof.
  destruct (trichotomy x) as [h | [-> | h]]; auto.
  - right. apply lt_irrefl.
  - right. intro p. now apply (pos_not_neg x).
Qed.
Lemma nonneg_sum_zero x y : 0 <= x -> 0 <= y -> x + y = 0 -> x = 0 /\ y = 0.
Proof.
  intros [hx | <-] hy h.
  - exfalso. apply (lt_irrefl K 0). rewrite <- h at 2. now apply pos_nonneg_add.
  - split; auto. now replace (0 + y) with y in h by ring.
Qed.
Lemma square_nonneg x : 0 <= x * x.
Proof.
  destruct (trichotomy x) as [h | [-> | h]].
  - left. now apply lt_mul.
  - right. ring.
  - replace (x * x) with (- x * - x) by ring. left. now apply lt_mul.
Qed.
Lemma square_pos x : x <> 0 -> 0 < x * x.
Proof.
  intro n. destruct (trichotomy x) as [h | [h | h]].
  - now apply lt_mul.
  - contradiction.
  - replace (x * x) with (- x * - x) by ring. now apply lt_mul.
Qed.

(** ** Division *)

Lemma mul_zero_cancel x y : x * y = 0 -> x <> 0 -> y = 0.
Proof.
  intros h n. replace y with (1 * y) by ring. rewrite <- (mul_inv K x n).
  replace (x * inv x * y) with (inv x * (x * y)) by ring. rewrite h. ring.
Qed.
Lemma pos_cancel x y : 0 < x -> 0 < x * y -> 0 < y.
Proof.
  intros hx h. destruct (trichotomy y) as [p | [-> | n]]; auto; exfalso.
  - apply (lt_irrefl K 0). now replace (x * 0) with (0 : K) in h by ring.
  - apply (pos_not_neg _ h). replace (- (x * y)) with (x * - y) by ring. now apply lt_mul.
Qed.
Lemma inv_pos x : 0 < x -> 0 < inv x.
Proof.
  intro h. apply (pos_cancel x); auto. rewrite mul_inv.
  - apply zero_lt_one.
  - now apply pos_neq_zero.
Qed.

End Consequences.
