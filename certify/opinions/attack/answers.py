"""Forged answers: a yes for a no or a no for a yes, with the evidence of something else."""

from random import Random

from certify.opinions.attack.corpus import Corpus, Draft, Forgery, Mutator


def _no_made_yes(random: Random, corpus: Corpus) -> Forgery:
    """A no becomes a yes, by points of the same pattern for another question if there are any."""
    name, question = random.choice(corpus.answers["no"])
    draft = Draft.of(corpus, name)
    own = [(n, q) for n, q in corpus.answers["yes"] if n == name]
    other, asked = random.choice(own or corpus.answers["yes"])
    draft.record[question] = corpus.record(other)[asked]
    return draft.finished()


def _yes_made_no(random: Random, corpus: Corpus) -> Forgery:
    """A yes becomes a no, by the proof of another pattern, with its final polynomials."""
    name, question = random.choice(corpus.answers["yes"])
    return _proved_by(corpus, name, question, random.choice(corpus.answers["no"]))


def _proof_of_another(random: Random, corpus: Corpus) -> Forgery:
    """A no gets the proof of another no."""
    name, question = random.choice(corpus.answers["no"])
    own = [(n, q) for n, q in corpus.answers["no"] if n == name]
    others = random.choice((own, corpus.answers["no"]))
    return _proved_by(corpus, name, question, random.choice(others))


def _proved_by(corpus: Corpus, name: str, question: str, no: tuple[str, str]) -> Forgery:
    draft, answer = Draft.of(corpus, name), corpus.record(no[0])[no[1]]
    draft.answer_no(question, corpus.proofs[answer["proof"]])
    if "final_polynomials" in answer:
        draft.record[question]["final_polynomials"] = answer["final_polynomials"]
    return draft.finished()


KINDS: dict[str, Mutator] = {
    "answer: no made yes": _no_made_yes,
    "answer: yes made no": _yes_made_no,
    "answer: proof of another no": _proof_of_another,
}
"""Kind -> how one forgery of it is made."""
