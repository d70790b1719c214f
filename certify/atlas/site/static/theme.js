// @ts-check
// Light or dark: the system's choice, until the reader makes another.
"use strict";

(() => {
  const root = document.documentElement;
  const system = window.matchMedia("(prefers-color-scheme: dark)");

  /** @returns {string | null} */
  function kept() {
    try {
      return localStorage.getItem("theme");
    } catch {
      return null; // a browser may refuse to keep anything for files
    }
  }

  /** @param {string} theme */
  function keep(theme) {
    try {
      localStorage.setItem("theme", theme);
    } catch {
      // then it holds for this page
    }
  }

  const isDark = () => (root.dataset.theme ?? (system.matches ? "dark" : "light")) === "dark";

  const before = kept();
  if (before) root.dataset.theme = before;

  document.addEventListener("DOMContentLoaded", () => {
    const button = document.getElementById("theme");
    if (!(button instanceof HTMLButtonElement)) return;
    const name = () => {
      button.textContent = isDark() ? "Light" : "Dark";
    };
    button.hidden = false;
    name();
    button.addEventListener("click", () => {
      root.dataset.theme = isDark() ? "light" : "dark";
      keep(root.dataset.theme);
      name();
      window.dispatchEvent(new Event("themechange"));
    });
    system.addEventListener("change", () => {
      name();
      window.dispatchEvent(new Event("themechange"));
    });
  });
})();
