// @ts-check
// The list of patterns: filters, search and order, all of which the address tells.
"use strict";

/* global TETRAHEDRA, readTetrahedra, patternsOf */

(() => {
  const form = /** @type {HTMLFormElement} */ (document.getElementById("filters"));
  const list = /** @type {HTMLUListElement} */ (document.getElementById("cards"));
  const told = /** @type {HTMLElement} */ (document.getElementById("found"));
  const cards = /** @type {HTMLLIElement[]} */ ([...list.children]);
  const EQUAL = ["size", "boundary", "realizable", "convex", "valid", "instances"];
  /** Orders, the first card first; cards that are alike keep the order of their names. */
  const ORDERS = {
    boundary: (/** @type {DOMStringMap} */ a, /** @type {DOMStringMap} */ b) =>
      (a.boundary ?? "").localeCompare(b.boundary ?? ""),
    instances: (/** @type {DOMStringMap} */ a, /** @type {DOMStringMap} */ b) =>
      Number(a.instances) - Number(b.instances),
    quality: (/** @type {DOMStringMap} */ a, /** @type {DOMStringMap} */ b) =>
      Number(b.quality || -1) - Number(a.quality || -1),
  };

  /** @returns {Record<string, string>} what the form asks for, without what is left empty */
  function asked() {
    const values = [...new FormData(form)].map(([name, value]) => [name, String(value).trim()]);
    return Object.fromEntries(values.filter(([, value]) => value));
  }

  /** @param {Record<string, string>} values */
  function fill(values) {
    for (const field of form.elements) {
      if (field instanceof HTMLInputElement || field instanceof HTMLSelectElement) {
        field.value = values[field.name] ?? "";
      }
    }
  }

  /**
   * @param {string} text
   * @returns {{fits: (name: string) => boolean, says: string}}
   */
  function search(text) {
    if (!text) return { fits: () => true, says: "" };
    const start = text.toUpperCase().replace(/\s/g, "");
    if (/^\d{1,2}(_[A-Z]{0,2})?$/.test(start)) {
      // With nothing behind its mark a number is that of the tetrahedra.
      const whole = start.includes("_") ? start : `${start}_`;
      return { fits: (name) => name.startsWith(whole), says: "" };
    }
    const complex = readTetrahedra(text);
    if (!complex) return { fits: () => false, says: "Neither a name nor a list of tetrahedra. " };
    const found = patternsOf(complex, TETRAHEDRA);
    const [first] = found;
    if (!first) return { fits: () => false, says: `No pattern has these ${complex.length} tetrahedra. ` };
    const [name, image] = first;
    const moves = [...image].map(([from, to]) => `${from} → ${to}`).join(", ");
    return { fits: (other) => found.has(other), says: `${name}, with ${moves}. ` };
  }

  function show() {
    const values = asked();
    const { fits, says } = search(values.q ?? "");
    let count = 0;
    for (const card of cards) {
      const own = card.dataset;
      const shown =
        EQUAL.every((name) => !values[name] || own[name] === values[name]) &&
        (!values.quality || (own.quality !== "" && Number(own.quality) >= Number(values.quality))) &&
        fits(own.name ?? "");
      card.hidden = !shown;
      count += Number(shown);
    }
    const order = ORDERS[/** @type {keyof ORDERS} */ (values.sort)];
    list.append(...(order ? [...cards].sort((a, b) => order(a.dataset, b.dataset)) : cards));
    told.textContent = `${says}${count} ${count === 1 ? "pattern" : "patterns"}`;
  }

  function read() {
    fill(Object.fromEntries(new URLSearchParams(location.hash.slice(1))));
    show();
  }

  form.addEventListener("input", () => {
    const values = new URLSearchParams(asked()).toString();
    history.replaceState(null, "", values ? `#${values}` : "#");
    show();
  });
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => {
    history.replaceState(null, "", "#");
    setTimeout(show);
  });
  window.addEventListener("hashchange", read);
  read();
})();
