(** * Clausal proofs

    A checker for refutations in the format LRAT without the RAT rule (section 3 of FORMAT.md),
    written as a Coq function and proved sound: if [refutes clauses proof] computes to [true], then
    no valuation satisfies all the clauses. The solver that found the proof, and the program that
    translated it to Coq, need not be trusted.

    A literal is a non-zero integer as in DIMACS: variable v or its negation -v. A valuation is a
    property [val] of variables. It is a proposition rather than a boolean, since later "variable v
    is true" will mean "such and such determinant is positive". Of [val] only the law of the
    excluded middle is demanded, variable by variable. *)

From Coq Require Import ZArith List FMapPositive.
Import ListNotations.
Module P := PositiveMap.

Definition clause : Type := list Z.

(** A step adds a clause under a number; the hints are numbers of earlier clauses. *)
Inductive step : Type := Step (number : positive) (added : clause) (hints : list positive).

(** ** The checker *)

(** A partial assignment maps some variables to true or false. Which literals does it make false?
    (0 is no literal, and counts as false.) *)
Definition is_false (a : P.t bool) (l : Z) : bool :=
  match l with
  | Zpos v => match P.find v a with Some b => negb b | None => false end
  | Zneg v => match P.find v a with Some b => b | None => false end
  | Z0 => true
  end.

(** The assignment that moreover makes the literal true. *)
Definition make_true (l : Z) (a : P.t bool) : P.t bool :=
  match l with Zpos v => P.add v true a | Zneg v => P.add v false a | Z0 => a end.

(** What a clause says under an assignment: all its literals are false; or all but one; or more
    than one is not false. [found] is the literal that was met so far and is not false. *)
Inductive status : Type := Conflict | Unit (l : Z) | Open.

Fixpoint look (a : P.t bool) (c : clause) (found : option Z) : status :=
  match c with
  | [] => match found with None => Conflict | Some l => Unit l end
  | l :: c' =>
      if is_false a l then look a c' found
      else match found with
           | None => look a c' (Some l)
           | Some m => if Z.eqb l m then look a c' found else Open
           end
  end.

(** A database maps numbers to clauses. Take the hints one by one: each makes one more literal
    true, and a last one is false altogether. *)
Fixpoint propagate (db : P.t clause) (hints : list positive) (a : P.t bool) : bool :=
  match hints with
  | [] => false
  | h :: hints' =>
      match P.find h db with
      | None => false
      | Some c =>
          match look a c None with
          | Conflict => true
          | Unit l => propagate db hints' (make_true l a)
          | Open => false
          end
      end
  end.

(** The assignment that makes all literals of a clause false. *)
Definition falsify (c : clause) : P.t bool :=
  fold_left (fun a l => make_true (- l) a) c (P.empty bool).

(** Replay a proof; its last step, and no other, must add the empty clause. *)
Fixpoint replay (db : P.t clause) (proof : list step) : bool :=
  match proof with
  | [] => false
  | Step n c hints :: proof' =>
      if propagate db hints (falsify c)
      then match c, proof' with
           | [], [] => true
           | [], _ => false
           | _, _ => replay (P.add n c db) proof'
           end
      else false
  end.

(** Add clauses to a database under the numbers n, n + 1, ... *)
Fixpoint load (n : positive) (cs : list clause) (db : P.t clause) : P.t clause :=
  match cs with [] => db | c :: cs' => load (Pos.succ n) cs' (P.add n c db) end.

Definition refutes (cs : list clause) (proof : list step) : bool :=
  replay (load 1 cs (P.empty clause)) proof.

Example a_refutation : refutes [[1]; [-1]]%Z [Step 3 [] [1; 2]]%positive = true.
Proof. reflexivity. Qed.
Example nothing_may_follow :
  refutes [[1]; [-1]]%Z [Step 3 [] [1; 2]; Step 4 [5%Z] [1; 2]]%positive = false.
Proof. reflexivity. Qed.
Example a_hint_is_missing : refutes [[1]; [-1]]%Z [Step 3 [] [1]]%positive = false.
Proof. reflexivity. Qed.

(** ** Its soundness *)

Section Soundness.
Variable val : positive -> Prop.
Hypothesis decidable : forall v, val v \/ ~ val v.

Definition literal_true (l : Z) : Prop :=
  match l with Zpos v => val v | Zneg v => ~ val v | Z0 => False end.
Definition clause_true (c : clause) : Prop := exists l, In l c /\ literal_true l.
Definition satisfied (db : P.t clause) : Prop :=
  forall n c, P.find n db = Some c -> clause_true c.
Definition agrees (a : P.t bool) : Prop :=
  forall v b, P.find v a = Some b -> if b then val v else ~ val v.

Lemma literal_decidable l : literal_true l \/ ~ literal_true l.
Proof. destruct l as [| v | v]; simpl; auto; destruct (decidable v); tauto. Qed.
Lemma clause_decidable c : clause_true c \/ ~ clause_true c.
Proof.
  induction c as [| l c IH].
  - right. now intros [l [[] _]].
  - destruct (literal_decidable l) as [t | f].
    + left. exists l. split; auto. now left.
    + destruct IH as [[m [i t]] | n].
      * left. exists m. split; auto. now right.
      * right. intros [m [[<- | i] t]]; [auto | apply n; now exists m].
Qed.
Lemma clause_true_cons l c : clause_true (l :: c) <-> literal_true l \/ clause_true c.
Proof.
  split.
  - intros [m [[<- | i] t]]; [now left | right; now exists m].
  - intros [t | [m [i t]]]; [exists l | exists m]; split; auto; [now left | now right].
Qed.

Lemma find_add A (m : P.t A) k v i :
  P.find i (P.add k v m) = if Pos.eqb i k then Some v else P.find i m.
Proof. destruct (Pos.eqb_spec i k) as [-> | ne]; [apply P.gss | now apply P.gso]. Qed.

Lemma is_false_sound a l : agrees a -> is_false a l = true -> ~ literal_true l.
Proof.
  intro h. destruct l as [| v | v]; simpl; auto;
    (destruct (P.find v a) as [b |] eqn:e; [| discriminate]);
    apply h in e; destruct b; try discriminate; tauto.
Qed.

Lemma look_sound a : agrees a -> forall c found,
  match look a c found with
  | Conflict => found = None /\ ~ clause_true c
  | Unit l => clause_true c \/ (exists m, found = Some m /\ literal_true m) -> literal_true l
  | Open => True
  end.
Proof.
  intros h. induction c as [| l c IH]; intro found; simpl.
  - destruct found as [m |].
    + intros [[l [[] _]] | (m' & e & t)]. congruence.
    + split; auto. now intros [l [[] _]].
  - destruct (is_false a l) eqn:e.
    + apply (is_false_sound a l h) in e. specialize (IH found).
      destruct (look a c found); rewrite ?clause_true_cons; tauto.
    + destruct found as [m |].
      * destruct (Z.eqb_spec l m) as [-> |]; [| exact I]. specialize (IH (Some m)).
        destruct (look a c (Some m)); auto; [now destruct IH |].
        rewrite clause_true_cons. intro t. apply IH.
        destruct t as [[t | t] | t]; [right; now exists m | now left | now right].
      * specialize (IH (Some l)). destruct (look a c (Some l)); auto; [now destruct IH |].
        rewrite clause_true_cons. intros [[t | t] | (m & e' & _)]; [| | discriminate]; apply IH;
          [right; now exists l | now left].
Qed.

Lemma make_true_sound a l : agrees a -> literal_true l -> agrees (make_true l a).
Proof.
  intros h t. destruct l as [| v | v]; cbn [make_true literal_true] in *; auto;
    intros w b; rewrite find_add; (destruct (Pos.eqb_spec w v) as [-> |]; [| apply h]);
    now intros [= <-].
Qed.

Lemma propagate_sound db : satisfied db ->
  forall hints a, agrees a -> propagate db hints a = true -> False.
Proof.
  intros hdb. induction hints as [| n hints IH]; intros a h; simpl; [discriminate |].
  destruct (P.find n db) as [c |] eqn:e; [| discriminate]. apply hdb in e.
  pose proof (look_sound a h c None) as s. destruct (look a c None).
  - tauto.
  - apply IH, make_true_sound; auto.
  - discriminate.
Qed.

Lemma falsify_sound c : ~ clause_true c -> agrees (falsify c).
Proof.
  unfold falsify.
  assert (empty : agrees (P.empty bool)) by (intros v b; rewrite P.gempty; discriminate).
  revert empty. generalize (P.empty bool). induction c as [| l c IH]; simpl; auto.
  intros a h n. rewrite clause_true_cons in n. apply IH; [| tauto].
  destruct l as [| v | v]; simpl in n; auto; (apply make_true_sound; auto); simpl.
  - tauto.
  - destruct (decidable v); tauto.
Qed.

Theorem replay_sound proof : forall db, satisfied db -> replay db proof = true -> False.
Proof.
  induction proof as [| [n c hints] proof IH]; intros db h; simpl; [discriminate |].
  destruct (propagate db hints (falsify c)) eqn:e; [| discriminate].
  assert (t : clause_true c).
  { destruct (clause_decidable c) as [| f]; auto. exfalso.
    exact (propagate_sound db h hints _ (falsify_sound c f) e). }
  destruct c as [| l c].
  - destruct t as [l [[] _]].
  - apply IH. intros m d. rewrite find_add. destruct (Pos.eqb m n); [now intros [= <-] | apply h].
Qed.

Lemma load_sound cs : forall n db,
  satisfied db -> (forall c, In c cs -> clause_true c) -> satisfied (load n cs db).
Proof.
  induction cs as [| c cs IH]; simpl; auto. intros n db h t. apply IH; auto.
  intros m d. rewrite find_add. destruct (Pos.eqb m n); [intros [= <-]; auto | apply h].
Qed.
Lemma empty_satisfied : satisfied (P.empty clause).
Proof. intros n c. now rewrite P.gempty. Qed.

Theorem refutes_sound cs proof :
  refutes cs proof = true -> (forall c, In c cs -> clause_true c) -> False.
Proof.
  intros h t. eapply replay_sound; [| exact h]. apply load_sound; auto using empty_satisfied.
Qed.
End Soundness.
