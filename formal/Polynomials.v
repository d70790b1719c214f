(** * Final polynomials

    Some sign vectors satisfy every Grassmann-Pluecker clause although no eight points have them. A
    final polynomial (Bokowski and Richter 1990; section 2 of FORMAT.md) shows this of signs that it
    assumes. For six points write

      A = [stab][stcd],  B = [stac][stbd],  C = [stad][stbc],  so that A = B - C.

    If B is not zero and C has not the sign of B, then A^2 = B^2 - 2 B C + C^2 >= B^2 > 0, and
    A^2 > B^2 if C is not zero. Let all the inequalities that a final polynomial lists follow in
    this way from the signs that it assumes, and one of them strictly. Then the product of all A^2
    exceeds that of all B^2, each taken as often as its multiplier says. If every determinant occurs
    equally often in both products, this is absurd: "not all of these signs" is a true clause. *)

From Coq Require Import List Bool Ring Permutation.
From Certify Require Import Definitions Barycentric Integral Lrat Formula Signs.
Import ListNotations.

Inductive sign : Type := Vanishes | Positive | Negative.
Definition six : Type := vertex * vertex * vertex * vertex * vertex * vertex.
Record final_polynomial : Type := FinalPolynomial {
  assumed : list (tetrahedron * sign);
  inequalities : list (nat * six) (* a multiplier, and s, t, a, b, c, d *)
}.

(** What a certificate gives for the answer no. *)
Definition refutation : Type := list final_polynomial * list step.

(** ** The check *)

Definition opposite_sign (s : sign) : sign :=
  match s with Vanishes => Vanishes | Positive => Negative | Negative => Positive end.
Definition sign_of (signs : list (tetrahedron * sign)) (q : tetrahedron) : option sign :=
  match find (fun x => same_tetrahedron (fst x) (fst (sorted q))) signs with
  | Some (_, s) => Some (if snd (sorted q) then s else opposite_sign s)
  | None => None
  end.
Definition sign_of_product (signs : list (tetrahedron * sign)) (x : term) : option sign :=
  match sign_of signs (fst x), sign_of signs (snd x) with
  | Some Vanishes, _ | _, Some Vanishes => Some Vanishes
  | Some Positive, s | s, Some Positive => s
  | Some Negative, Some Negative => Some Positive
  | _, _ => None
  end.

Definition larger (i : six) : term := let '(s, t, a, b, c, d) := i in ((s, t, a, b), (s, t, c, d)).
Definition smaller (i : six) : term := let '(s, t, a, b, c, d) := i in ((s, t, a, c), (s, t, b, d)).
Definition rest (i : six) : term := let '(s, t, a, b, c, d) := i in ((s, t, a, d), (s, t, b, c)).

(** Does the inequality follow from the signs? Strictly? *)
Definition follows (signs : list (tetrahedron * sign)) (i : six) : option bool :=
  match sign_of_product signs (smaller i), sign_of_product signs (rest i) with
  | Some Positive, Some Vanishes | Some Negative, Some Vanishes => Some false
  | Some Positive, Some Negative | Some Negative, Some Positive => Some true
  | _, _ => None
  end.

(** The factors of a product, in increasing order of vertices. *)
Definition factors (x : term) : list tetrahedron := [fst (sorted (fst x)); fst (sorted (snd x))].
Fixpoint times (n : nat) (l : list tetrahedron) : list tetrahedron :=
  match n with 0 => [] | S n' => l ++ times n' l end.

(** All inequalities together: the factors of the larger and of the smaller side, and whether the
    inequality between them is strict. *)
Fixpoint multiplied (signs : list (tetrahedron * sign)) (is : list (nat * six))
    : option (list tetrahedron * list tetrahedron * bool) :=
  match is with
  | [] => Some ([], [], false)
  | (n, i) :: is' =>
      match follows signs i, multiplied signs is' with
      | Some s, Some (l, m, s') =>
          Some (times n (factors (larger i)) ++ l, times n (factors (smaller i)) ++ m,
            (s && Nat.ltb 0 n) || s')
      | _, _ => None
      end
  end.

Fixpoint take_out (x : tetrahedron) (l : list tetrahedron) : option (list tetrahedron) :=
  match l with
  | [] => None
  | y :: l' => if same_tetrahedron x y then Some l' else option_map (cons y) (take_out x l')
  end.
Fixpoint same_members (l m : list tetrahedron) : bool :=
  match l with
  | [] => match m with [] => true | _ => false end
  | x :: l' => match take_out x m with Some m' => same_members l' m' | None => false end
  end.

Definition absurd_signs (f : final_polynomial) : bool :=
  match multiplied (assumed f) (inequalities f) with
  | Some (l, m, true) => same_members l m
  | _ => false
  end.

(** The clause that the final polynomial adds, if it passes. *)
Definition excluded (f : final_polynomial) : list literal :=
  flat_map (fun x => match snd x with
    | Positive => [Not (fst x) true]
    | Negative => [Not (fst x) false]
    | Vanishes => [Is (fst x) true; Is (fst x) false]
    end) (assumed f).
Definition polynomial_clauses (fs : list final_polynomial) : list (list literal) :=
  map excluded (filter absurd_signs fs).

(** ** Its soundness *)

Lemma take_out_perm x l : forall m, take_out x l = Some m -> Permutation (x :: m) l.
Proof.
  induction l as [| y l IH]; simpl; [discriminate |]. intro m.
  destruct (same_tetrahedron x y) eqn:e.
  - intros [= <-]. apply same_tetrahedron_eq in e as <-. reflexivity.
  - destruct (take_out x l) as [m' |]; simpl; [| discriminate]. intros [= <-].
    rewrite perm_swap. now apply perm_skip, IH.
Qed.
Lemma same_members_perm l : forall m, same_members l m = true -> Permutation l m.
Proof.
  induction l as [| x l IH]; simpl; intro m.
  - destruct m; [reflexivity | discriminate].
  - destruct (take_out x m) as [m' |] eqn:e; [| discriminate]. intro h.
    apply take_out_perm in e. rewrite <- e. now apply perm_skip, IH.
Qed.

Section Sound.
Variable K : ordered_field.
Local Open Scope K_scope.
Add Ring K_ring : (K_ring K).
Variable p : vertex -> point K.
Variable g : bool.

Definition sign_is (x : K) (s : sign) : Prop :=
  match s with Vanishes => x = 0 | Positive => 0 < x | Negative => 0 < - x end.

Local Notation D := (Signs.D p g).
Local Notation product := (Signs.product K p g).
Definition square (q : tetrahedron) : K := D q * D q.
Fixpoint squares (l : list tetrahedron) : K :=
  match l with [] => 1 | q :: l' => square q * squares l' end.

Lemma sorted_D q : D q = signed (snd (sorted q)) (D (fst (sorted q))).
Proof.
  unfold Signs.D. rewrite (sorted_sound K p q), !signed_signed. now destruct g, (snd (sorted q)).
Qed.
Lemma squares_app l m : squares (l ++ m) = squares l * squares m.
Proof. induction l as [| q l IH]; simpl; [| rewrite IH]; ring. Qed.
Lemma squares_perm l m : Permutation l m -> squares l = squares m.
Proof. induction 1; simpl; congruence || ring. Qed.
Lemma squares_factors x : squares (factors x) = product x * product x.
Proof.
  unfold factors, Signs.product, squares, square. rewrite (sorted_D (fst x)), (sorted_D (snd x)).
  destruct (snd (sorted (fst x))), (snd (sorted (snd x))); cbn [signed]; ring.
Qed.

Section Assumed.
Variable signs : list (tetrahedron * sign).
Hypothesis true_signs : forall q s, In (q, s) signs -> sign_is (D q) s.

Lemma sign_of_sound q s : sign_of signs q = Some s -> sign_is (D q) s.
Proof.
  unfold sign_of. destruct (find _ signs) as [[r s'] |] eqn:e; [| discriminate]. intros [= <-].
  apply find_some in e as [i e]. apply same_tetrahedron_eq in e. simpl in e. subst r.
  apply true_signs in i. rewrite sorted_D. destruct (snd (sorted q)); simpl; auto.
  destruct s'; simpl in *; auto.
  - rewrite i. apply opp_zero.
  - now rewrite opp_opp.
Qed.
Lemma sign_of_product_sound x s : sign_of_product signs x = Some s -> sign_is (product x) s.
Proof.
  unfold sign_of_product, Signs.product.
  pose proof (sign_of_sound (fst x)) as h1. pose proof (sign_of_sound (snd x)) as h2.
  destruct (sign_of signs (fst x)) as [s1 |]; [specialize (h1 _ eq_refl) | clear h1];
    (destruct (sign_of signs (snd x)) as [s2 |]; [specialize (h2 _ eq_refl) | clear h2]);
    try destruct s1; try destruct s2; try discriminate; intros [= <-]; simpl in *;
    try (rewrite h1; ring); try (rewrite h2; ring).
  - now apply lt_mul.
  - replace (- (D (fst x) * D (snd x))) with (D (fst x) * - D (snd x)) by ring. now apply lt_mul.
  - replace (- (D (fst x) * D (snd x))) with (- D (fst x) * D (snd x)) by ring. now apply lt_mul.
  - replace (D (fst x) * D (snd x)) with (- D (fst x) * - D (snd x)) by ring. now apply lt_mul.
Qed.

Lemma three_terms i : product (larger i) = product (smaller i) - product (rest i).
Proof.
  destruct i as [[[[[s t] a] b] c] d]. unfold Signs.product, Signs.D. cbn [larger smaller rest fst snd volume].
  destruct g; cbn [signed]; coordinates.
Qed.

(** Strict or not, as a flag. *)
Definition exceeds (strict : bool) (x y : K) : Prop := 0 < y /\ (if strict then y < x else y <= x).

Lemma follows_sound i strict : follows signs i = Some strict ->
  exceeds strict (squares (factors (larger i))) (squares (factors (smaller i))).
Proof.
  unfold follows, exceeds. rewrite !squares_factors, (three_terms i). intro h.
  pose proof (sign_of_product_sound (smaller i)) as hB. pose proof (sign_of_product_sound (rest i)) as hC.
  destruct (sign_of_product signs (smaller i)) as [sB |]; [specialize (hB _ eq_refl) | discriminate].
  destruct (sign_of_product signs (rest i)) as [sC |]; [specialize (hC _ eq_refl) | now destruct sB].
  set (B := product (smaller i)) in *. set (C := product (rest i)) in *.
  assert (neg : 0 < B \/ 0 < - B -> 0 < B * B).
  { intros [k | k]; [| replace (B * B) with (- B * - B) by ring]; now apply lt_mul. }
  destruct sB, sC; simpl in *; try discriminate; injection h as <-; (split; [tauto |]).
  - right. rewrite hC. ring.
  - apply <- lt_sub. replace ((B - C) * (B - C) - B * B) with (B * - C + B * - C + - C * - C) by ring.
    repeat apply pos_add; now apply lt_mul.
  - right. rewrite hC. ring.
  - apply <- lt_sub. replace ((B - C) * (B - C) - B * B) with (- B * C + - B * C + C * C) by ring.
    repeat apply pos_add; now apply lt_mul.
Qed.
Lemma exceeds_mul s s' x y x' y' : exceeds s x y -> exceeds s' x' y' ->
  exceeds (s || s') (x * x') (y * y').
Proof.
  unfold exceeds. intros [py h] [py' h']. split; [now apply lt_mul |].
  assert (e : x * x' - y * y' = (x - y) * (x' - y') + (x - y) * y' + y * (x' - y')) by ring.
  assert (w : forall (t : bool) (u v : K), (if t then v < u else v <= u) -> 0 <= u - v).
  { intros [] u v k; [left; now apply -> lt_sub | now apply -> le_sub]. }
  pose proof (w _ _ _ h) as n. pose proof (w _ _ _ h') as n'.
  assert (n1 : 0 <= (x - y) * (x' - y')) by now apply nonneg_mul.
  assert (n2 : 0 <= (x - y) * y') by (apply nonneg_mul; auto; now left).
  assert (n3 : 0 <= y * (x' - y')) by (apply nonneg_mul; auto; now left).
  destruct s; simpl.
  - apply <- lt_sub. rewrite e. apply pos_nonneg_add; auto. apply nonneg_pos_add; auto.
    apply lt_mul; auto. now apply -> lt_sub.
  - destruct s'.
    + apply <- lt_sub. rewrite e. apply nonneg_pos_add; [now apply nonneg_add |].
      apply lt_mul; auto. now apply -> lt_sub.
    + apply <- le_sub. rewrite e. repeat apply nonneg_add; auto.
Qed.
Lemma exceeds_one : exceeds false 1 1.
Proof. split; [apply zero_lt_one | now right]. Qed.
Lemma times_exceeds s l m n : exceeds s (squares l) (squares m) ->
  exceeds (s && Nat.ltb 0 n) (squares (times n l)) (squares (times n m)).
Proof.
  intro h. induction n as [| n IH]; cbn [times].
  - rewrite andb_false_r. apply exceeds_one.
  - rewrite !squares_app. replace (s && Nat.ltb 0 (S n)) with (s || (s && Nat.ltb 0 n)).
    + exact (exceeds_mul _ _ _ _ _ _ h IH).
    + now destruct s.
Qed.
Lemma multiplied_sound is : forall l m s, multiplied signs is = Some (l, m, s) ->
  exceeds s (squares l) (squares m).
Proof.
  induction is as [| [n i] is IH]; simpl; intros l m s.
  - intros [= <- <- <-]. apply exceeds_one.
  - destruct (follows signs i) as [t |] eqn:e; [| discriminate]. apply follows_sound in e.
    destruct (multiplied signs is) as [[[l' m'] s'] |]; [| discriminate]. intros [= <- <- <-].
    rewrite !squares_app. apply exceeds_mul; auto. now apply times_exceeds.
Qed.
End Assumed.

Theorem polynomial_clauses_sound fs c : In c (polynomial_clauses fs) -> true_clause p g c.
Proof.
  unfold polynomial_clauses. rewrite in_map_iff. intros (f & <- & i). apply filter_In in i as [_ i].
  apply by_contradiction. intro fail.
  assert (signs : forall q s, In (q, s) (assumed f) -> sign_is (D q) s).
  { intros q s iq.
    assert (h : forall l, In l match s with Positive => [Not q true] | Negative => [Not q false]
      | Vanishes => [Is q true; Is q false] end -> fails p g l).
    { intros l il. apply fail. unfold excluded. apply in_flat_map. now exists (q, s). }
    destruct s; simpl in *.
    - pose proof (h _ (or_introl eq_refl)) as h1. pose proof (h _ (or_intror (or_introl eq_refl))) as h2.
      simpl in h1, h2. destruct (trichotomy K (D q)) as [k | [k | k]]; [| exact k |]; contradiction.
    - exact (h _ (or_introl eq_refl)).
    - exact (h _ (or_introl eq_refl)). }
  unfold absurd_signs in i.
  destruct (multiplied (assumed f) (inequalities f)) as [[[l m] [|]] |] eqn:e; try discriminate.
  apply multiplied_sound in e as [_ e]; auto. apply same_members_perm, squares_perm in i.
  rewrite i in e. now apply lt_irrefl in e.
Qed.
End Sound.
