(** * Faces and counting

    A face is a list of vertices; in the canonical form of a face they are increasing, so that the
    faces with k vertices are [choices k all_vertices]. To count is to count members of these lists
    that pass a test. *)

From Coq Require Import List Bool Permutation PeanoNat Lia.
From Certify Require Import Barycentric Integral.
From Certify Require Export Triangulation.
Import ListNotations.

(** ** Tests of lists that stop early

    The library's [existsb] and [forallb] go through the whole list when they compute. *)

Fixpoint any {A} (f : A -> bool) (l : list A) : bool :=
  match l with [] => false | x :: l' => if f x then true else any f l' end.
Fixpoint every {A} (f : A -> bool) (l : list A) : bool :=
  match l with [] => true | x :: l' => if f x then every f l' else false end.
Lemma any_exists A (f : A -> bool) l : any f l = true <-> exists x, In x l /\ f x = true.
Proof.
  rewrite <- existsb_exists. induction l as [| x l IH]; simpl; [tauto |].
  destruct (f x); simpl; tauto.
Qed.
Lemma every_forall A (f : A -> bool) l : every f l = true <-> forall x, In x l -> f x = true.
Proof.
  rewrite <- forallb_forall. induction l as [| x l IH]; simpl; [tauto |].
  destruct (f x); simpl; [exact IH | tauto].
Qed.

Local Open Scope lazy_bool_scope.

(** [a &&& b] and [a ||| b] do not look at b where a decides. *)
Lemma lazy_and (a b : bool) : (a &&& b) = true <-> a = true /\ b = true.
Proof. destruct a, b; intuition discriminate. Qed.
Lemma lazy_or (a b : bool) : (a ||| b) = true <-> a = true \/ b = true.
Proof. destruct a, b; intuition discriminate. Qed.

(** ** Counting *)

Fixpoint count {A} (f : A -> bool) (l : list A) : nat :=
  match l with [] => 0 | x :: l' => Nat.b2n (f x) + count f l' end.
Fixpoint total {A} (f : A -> nat) (l : list A) : nat :=
  match l with [] => 0 | x :: l' => f x + total f l' end.

Section Counting.
Context {A : Type}.
Implicit Types (f g : A -> bool) (l : list A).

Lemma count_total f l : count f l = total (fun x => Nat.b2n (f x)) l.
Proof. induction l; simpl; auto. Qed.
Lemma total_ext (f g : A -> nat) l : (forall x, In x l -> f x = g x) -> total f l = total g l.
Proof. induction l; simpl; auto. Qed.
Lemma count_ext f g l : (forall x, In x l -> f x = g x) -> count f l = count g l.
Proof. induction l as [| x l IH]; simpl; intro h; auto. rewrite (h x), IH; auto. Qed.
Lemma total_add (f g : A -> nat) l : total (fun x => f x + g x) l = total f l + total g l.
Proof. induction l; simpl; lia. Qed.
Lemma total_scale k (f : A -> nat) l : total (fun x => k * f x) l = k * total f l.
Proof. induction l; simpl; lia. Qed.
Lemma count_app f l m : count f (l ++ m) = count f l + count f m.
Proof. induction l; simpl; lia. Qed.
Lemma count_filter f g l : count f (filter g l) = count (fun x => g x && f x) l.
Proof. induction l as [| x l IH]; simpl; auto. destruct (g x); simpl; lia. Qed.
Lemma count_length f l : count f l = length (filter f l).
Proof. induction l as [| x l IH]; simpl; auto. destruct (f x); simpl; lia. Qed.
Lemma count_le f l : count f l <= length l.
Proof. induction l as [| x l IH]; simpl; auto. destruct (f x); simpl; lia. Qed.
Lemma count_split f g l : count f l = count (fun x => g x && f x) l + count (fun x => negb (g x) && f x) l.
Proof. induction l as [| x l IH]; simpl; auto. destruct (g x); simpl; lia. Qed.
Lemma count_zero f l : count f l = 0 <-> forall x, In x l -> f x = false.
Proof.
  induction l as [| x l IH]; simpl; [tauto |]. split.
  - intros h y [<- | i]; [destruct (f x); auto; discriminate | apply IH; auto; lia].
  - intro h. rewrite (h x) by auto. apply IH. auto.
Qed.
Lemma count_some f l : count f l <> 0 -> exists x, In x l /\ f x = true.
Proof.
  induction l as [| x l IH]; simpl; [tauto |]. destruct (f x) eqn:e; [exists x; auto |].
  intro h. destruct (IH h) as (y & i & t). exists y. auto.
Qed.
Lemma count_choices f l : forall k c, In c (choices k l) -> forallb f c = true -> k <= count f l.
Proof.
  induction l as [| x l IH]; intros [| k] c; simpl; try lia; try tauto.
  rewrite in_app_iff, in_map_iff. intros [(d & <- & i) | i] h.
  - simpl in h. apply andb_true_iff in h as [-> h]. apply IH in i; auto. simpl. lia.
  - apply IH in i; auto. lia.
Qed.
End Counting.

Lemma count_map A C (f : A -> bool) (h : C -> A) l : count f (map h l) = count (fun x => f (h x)) l.
Proof. induction l; simpl; auto. Qed.
Lemma total_swap A C (f : A -> C -> nat) l m :
  total (fun x => total (f x) m) l = total (fun y => total (fun x => f x y) l) m.
Proof.
  induction l as [| x l IH]; simpl.
  - induction m; simpl; auto.
  - now rewrite IH, <- total_add.
Qed.

(** ** Faces *)

Definition subset (f g : list vertex) : bool := every (fun v => mem v g) f.
Lemma subset_iff f g : subset f g = true <-> incl f g.
Proof.
  unfold subset. rewrite every_forall. split; intros h v i; apply mem_iff; auto.
Qed.
Lemma subset_same f f' g g' : (forall v, In v f <-> In v f') -> (forall v, In v g <-> In v g') ->
  subset f g = subset f' g'.
Proof.
  intros h k. apply eq_true_iff_eq. rewrite !subset_iff. unfold incl. split; intros i v.
  - rewrite <- h, <- k. auto.
  - rewrite h, k. auto.
Qed.

Definition increasing (f : list vertex) : list vertex := filter (fun v => mem v f) all_vertices.
Lemma in_increasing v f : In v (increasing f) <-> In v f.
Proof. unfold increasing. rewrite filter_In, mem_iff. pose proof (in_all_vertices v). tauto. Qed.
Lemma increasing_permutation f : NoDup f -> Permutation (increasing f) f.
Proof.
  intro h. apply NoDup_Permutation; [apply NoDup_filter, all_vertices_nodup | exact h |].
  intro v. apply in_increasing.
Qed.
Lemma choices_filter A (f : A -> bool) l : In (filter f l) (choices (length (filter f l)) l).
Proof.
  induction l as [| x l IH]; simpl; auto. destruct (f x); simpl.
  - apply in_app_iff. left. apply in_map, IH.
  - destruct (filter f l) as [| y m]; simpl in *; auto. apply in_app_iff. now right.
Qed.
Definition faces (k : nat) : list (list vertex) := choices k all_vertices.
Arguments faces : simpl never.
Lemma increasing_face f : NoDup f -> In (increasing f) (faces (length f)).
Proof.
  intro h. rewrite <- (Permutation_length (increasing_permutation f h)). apply choices_filter.
Qed.

Definition distinct (f : list vertex) : bool := Nat.eqb (length (increasing f)) (length f).
Lemma distinct_iff f : distinct f = true <-> NoDup f.
Proof.
  unfold distinct. rewrite Nat.eqb_eq. split; intro h.
  - apply (NoDup_incl_NoDup (l := increasing f)); [apply NoDup_filter, all_vertices_nodup | lia |].
    intros v i. now apply in_increasing.
  - now apply Permutation_length, increasing_permutation.
Qed.

(** A face with k vertices has k different ones. *)
Lemma face_nodup k f : k <= 4 -> In f (faces k) -> NoDup f /\ length f = k.
Proof.
  intros hk h. rewrite <- distinct_iff, <- Nat.eqb_eq, <- andb_true_iff. revert f h.
  apply forallb_forall. destruct k as [| [| [| [| [| k]]]]]; try lia; vm_compute; reflexivity.
Qed.
Lemma face_1 f : In f (faces 1) -> exists a, f = [a].
Proof.
  intro h. apply face_nodup in h as [_ h]; [| lia].
  destruct f as [| a [|]]; try discriminate. now exists a.
Qed.
Lemma face_2 f : In f (faces 2) -> exists a b, f = [a; b] /\ a <> b.
Proof.
  intro h. apply face_nodup in h as [n h]; [| lia].
  destruct f as [| a [| b [|]]]; try discriminate. exists a, b. split; auto.
  inversion n; simpl in *. intuition.
Qed.
Lemma face_3 f : In f (faces 3) -> exists a b c, f = [a; b; c] /\ NoDup [a; b; c].
Proof.
  intro h. apply face_nodup in h as [n h]; [| lia].
  destruct f as [| a [| b [| c [|]]]]; try discriminate. now exists a, b, c.
Qed.
Lemma face_4 f : In f (faces 4) -> exists a b c d, f = [a; b; c; d] /\ NoDup [a; b; c; d].
Proof.
  intro h. apply face_nodup in h as [n h]; [| lia].
  destruct f as [| a [| b [| c [| d [|]]]]]; try discriminate. now exists a, b, c, d.
Qed.

(** Permutations of faces, by inclusion. *)
Lemma permutation_subset f g : NoDup f -> length g <= length f -> subset f g = true -> Permutation f g.
Proof. intros. apply NoDup_Permutation_bis; auto. now apply subset_iff. Qed.
Lemma permutation_iff f g : NoDup f -> length f = length g ->
  (Permutation f g <-> subset f g = true).
Proof.
  intros n e. split; [| apply permutation_subset; auto; lia].
  intro h. apply subset_iff. intros v. now apply Permutation_in.
Qed.

(** ** The faces of a complex

    [used T f]: f is a face of one of the tetrahedra; [covers D f]: of one of the triangles. *)

Definition used (T : list tetrahedron) (f : list vertex) : bool :=
  any (fun t => subset f (vertices t)) T.
Definition covers (D : list triangle) (f : list vertex) : bool :=
  any (fun t => subset f (corners t)) D.

Lemma used_iff T f : used T f = true <-> exists t, In t T /\ subset f (vertices t) = true.
Proof. apply any_exists. Qed.
Lemma covers_iff D f : covers D f = true <-> exists t, In t D /\ subset f (corners t) = true.
Proof. apply any_exists. Qed.
Lemma covers_cons t D f : covers (t :: D) f = subset f (corners t) || covers D f.
Proof. reflexivity. Qed.

Lemma any_same A (f g : A -> bool) l : (forall x, f x = g x) -> any f l = any g l.
Proof. intro h. induction l as [| x l IH]; simpl; auto. now rewrite h, IH. Qed.
Lemma used_same T f g : (forall v, In v f <-> In v g) -> used T f = used T g.
Proof. intro h. apply any_same. intro t. apply subset_same; tauto. Qed.
Lemma covers_same D f g : (forall v, In v f <-> In v g) -> covers D f = covers D g.
Proof. intro h. apply any_same. intro t. apply subset_same; tauto. Qed.
Lemma subset_trans f g h : subset f g = true -> subset g h = true -> subset f h = true.
Proof. rewrite !subset_iff. apply incl_tran. Qed.
Lemma used_subset T f g : subset f g = true -> used T g = true -> used T f = true.
Proof.
  rewrite !used_iff. intros h (t & i & k). exists t. eauto using subset_trans.
Qed.

Lemma length_vertices t : length (vertices t) = 4.
Proof. now destruct t as [[[a b] c] d]. Qed.
Lemma length_corners t : length (corners t) = 3.
Proof. now destruct t as [[a b] c]. Qed.

Lemma face_covers D a b c : NoDup [a; b; c] -> (face D a b c <-> covers D [a; b; c] = true).
Proof.
  intro n. unfold face. rewrite covers_iff.
  split; intros (t & i & h); exists t; split; auto; revert h; apply permutation_iff; auto;
    now rewrite length_corners.
Qed.

Section Spans.
Variable T : list tetrahedron.
Hypothesis T_nodup : forall t, In t T -> NoDup (vertices t).

Lemma spans_used a b c d :
  spans T a b c d <-> NoDup [a; b; c; d] /\ used T [a; b; c; d] = true.
Proof.
  unfold spans. rewrite used_iff. split.
  - intros (t & i & h). split.
    + now apply (Permutation_NoDup (Permutation_sym h)), T_nodup.
    + exists t. split; auto. apply subset_iff. intro v. now apply Permutation_in.
  - intros (n & t & i & h). exists t. split; auto. apply permutation_subset; auto.
    now rewrite length_vertices.
Qed.
Lemma spans_permutation a b c d a' b' c' d' : Permutation [a; b; c; d] [a'; b'; c'; d'] ->
  spans T a b c d -> spans T a' b' c' d'.
Proof.
  intros p (t & i & h). exists t. split; auto. eauto using Permutation_trans, Permutation_sym.
Qed.

(** A face that is used is one of a tetrahedron in canonical form. *)
Lemma used_tetrahedron f : used T f = true ->
  exists q, In q (faces 4) /\ subset f q = true /\ used T q = true.
Proof.
  rewrite used_iff. intros (t & i & h). pose proof (T_nodup t i) as n.
  exists (increasing (vertices t)). split; [| split].
  - rewrite <- (length_vertices t). now apply increasing_face.
  - rewrite subset_iff in *. intros v j. apply in_increasing. auto.
  - apply used_iff. exists t. split; auto. apply subset_iff. intros v. now rewrite in_increasing.
Qed.
End Spans.
