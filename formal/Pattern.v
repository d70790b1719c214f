(** * A pattern with its name, and what its certificate claims

    The module Catalogue, written by generate.py from the folder certificates/, lists the 174. *)

From Coq Require Import List String.
From Certify Require Import Definitions.
Import ListNotations.

Inductive answer : Type := Yes | No | Unknown.

Record pattern : Type := Pattern {
  name : string;
  claimed_realizable : answer;
  claimed_convex : answer;
  claimed_valid : answer;
  tetrahedra : list tetrahedron
}.

(** The patterns for whose having no valid hexahedron intermediate values of cubic polynomials are
    used. *)
Definition uses_intermediate_values : list string :=
  ["11_AD"; "11_AE"; "12_M"; "12_N"; "12_T"; "12_W"; "13_AA"; "13_AB"; "13_C"; "13_L"; "13_Y"; "13_Z";
   "14_Q"; "14_S"; "15_K"]%string.
Definition needs_intermediate_values (x : pattern) : bool :=
  existsb (String.eqb (name x)) uses_intermediate_values.

Definition is_yes (a : answer) : bool := match a with Yes => true | _ => false end.
Definition is_no (a : answer) : bool := match a with No => true | _ => false end.
