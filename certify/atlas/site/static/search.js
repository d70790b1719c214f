// @ts-check
// Which pattern is a list of tetrahedra, however its vertices are called?
"use strict";

/** @typedef {string[][]} Complex tetrahedra, each as four names of vertices */

/**
 * Read tetrahedra: words of four digits or letters, or numbers of which every four are one.
 * @param {string} text
 * @returns {Complex | null} null if it is not a list of tetrahedra
 */
function readTetrahedra(text) {
  const words = text.match(/[\p{L}\p{N}]+/gu) ?? [];
  const inOne = words.length > 0 && words.every((word) => [...word].length === 4);
  const flat = inOne ? words.flatMap((word) => [...word]) : words;
  if (flat.length === 0 || flat.length % 4) return null;
  const found = [];
  for (let k = 0; k < flat.length; k += 4) found.push(flat.slice(k, k + 4));
  return found.every((tetrahedron) => new Set(tetrahedron).size === 4) ? found : null;
}

/**
 * Return a colour for each vertex, the same for vertices that a relabelling may exchange.
 * @param {Complex} complex
 * @returns {Map<string, string>}
 */
function colours(complex) {
  let colour = new Map(complex.flat().map((vertex) => [vertex, ""]));
  for (let round = 0; round < 3; round++) {
    const near = new Map([...colour.keys()].map((vertex) => [vertex, /** @type {string[]} */ ([])]));
    for (const tetrahedron of complex) {
      for (const vertex of tetrahedron) {
        const others = tetrahedron.filter((other) => other !== vertex);
        near.get(vertex)?.push(others.map((other) => colour.get(other)).sort().join("."));
      }
    }
    const told = [...near].map(([vertex, seen]) => [vertex, seen.sort().join("|")]);
    const names = [...new Set(told.map(([, seen]) => seen))].sort();
    colour = new Map(told.map(([vertex, seen]) => [vertex, `${names.indexOf(seen)}:${seen.length}`]));
  }
  return colour;
}

/**
 * Return a relabelling that takes one complex to another, or null.
 * @param {Complex} one
 * @param {Complex} other
 * @returns {Map<string, string> | null}
 */
function relabelling(one, other) {
  if (one.length !== other.length) return null;
  const [from, to] = [colours(one), colours(other)];
  const sorted = (/** @type {Map<string, string>} */ map) => [...map.values()].sort().join(" ");
  if (sorted(from) !== sorted(to)) return null;
  const key = (/** @type {string[]} */ tetrahedron) => [...tetrahedron].sort().join(" ");
  const wanted = new Set(other.map(key));
  const vertices = [...from.keys()];
  /** @type {Map<string, string>} */
  const image = new Map();

  /** @param {number} k @returns {boolean} */
  function extend(k) {
    if (k === vertices.length) return true;
    for (const [candidate, colour] of to) {
      if (colour !== from.get(vertices[k]) || [...image.values()].includes(candidate)) continue;
      image.set(vertices[k], candidate);
      const done = one.filter((tetrahedron) => tetrahedron.every((vertex) => image.has(vertex)));
      const fits = done.every((t) => wanted.has(key(t.map((vertex) => image.get(vertex) ?? ""))));
      if (fits && extend(k + 1)) return true;
      image.delete(vertices[k]);
    }
    return false;
  }
  return extend(0) ? image : null;
}

/**
 * Return the patterns that a complex is, each with a relabelling.
 * @param {Complex} complex
 * @param {Record<string, string[]>} patterns
 * @returns {Map<string, Map<string, string>>}
 */
function patternsOf(complex, patterns) {
  const found = new Map();
  for (const [name, tetrahedra] of Object.entries(patterns)) {
    const image = relabelling(complex, tetrahedra.map((word) => [...word]));
    if (image) found.set(name, image);
  }
  return found;
}
