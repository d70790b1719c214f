(** * A pattern with its name, and what its certificate claims

    The module Catalogue, written by generate.py from the folder certificates/, lists the 174. *)

From Coq Require Import List String.
From Certify Require Import Definitions.

Inductive answer : Type := Yes | No | Unknown.

Record pattern : Type := Pattern {
  name : string;
  claimed_realizable : answer;
  claimed_convex : answer;
  claimed_valid : answer;
  tetrahedra : list tetrahedron
}.

Definition is_yes (a : answer) : bool := match a with Yes => true | _ => false end.
Definition is_no (a : answer) : bool := match a with No => true | _ => false end.
