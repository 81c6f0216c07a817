/* Under each result of the search, the words around what was searched for, which are marked.

Sphinx would fetch the pages for that, and a browser fetches nothing from a folder: the texts of all
pages come as a script, search_texts.js, which conf.py writes. */

"use strict";

const EXCERPT_LETTERS = 220;
const WORD = /[^\s.,;:!?()[\]{}<>/\\|"'“”„…▸+=*]+/g;

/* Return the words of a text, each with its place: [word, index]. */
function wordsOf(text) {
  const found = [];
  text.replace(WORD, (word, index) => found.push([word, index]));
  return found;
}

/* Return pieces [text, is marked] of the part of a page that holds most of the searched stems. */
function excerptOf(text, stems, stem) {
  const hits = wordsOf(text).filter(([word]) => stems.has(stem(word.toLowerCase())));
  if (!hits.length) return [];
  const within = ([, from]) => hits.filter(([, at]) => at >= from && at < from + EXCERPT_LETTERS);
  const different = (hit) => new Set(within(hit).map(([word]) => stem(word.toLowerCase()))).size;
  const [, first] = hits.reduce((best, hit) => (different(hit) > different(best) ? hit : best));
  const before = text.lastIndexOf(" ", Math.max(0, first - EXCERPT_LETTERS / 4));
  const start = first < EXCERPT_LETTERS / 4 ? 0 : before + 1;
  const space = text.indexOf(" ", start + EXCERPT_LETTERS);
  const end = space < 0 ? text.length : space;
  const pieces = [];
  let at = start;
  for (const [word, index] of hits.filter(([, place]) => place >= start && place < end)) {
    pieces.push([text.slice(at, index), false], [word, true]);
    at = index + word.length;
  }
  pieces.push([text.slice(at, end), false]);
  if (start > 0) pieces.unshift(["… ", false]);
  if (end < text.length) pieces.push([" …", false]);
  return pieces.filter(([piece]) => piece);
}

function showExcerpt(item, stems, stem) {
  const link = item.querySelector("a");
  const page = link ? link.getAttribute("href").split("#")[0].replace(/\.html$/, "") : "";
  const pieces = excerptOf(SEARCH_TEXTS[page] || "", stems, stem);
  if (!pieces.length || item.querySelector(".excerpt")) return;
  const excerpt = item.appendChild(document.createElement("p"));
  excerpt.className = "context excerpt";
  for (const [piece, isMarked] of pieces) {
    const part = excerpt.appendChild(document.createElement(isMarked ? "mark" : "span"));
    part.textContent = piece;
  }
}

if (typeof document !== "undefined")
  document.addEventListener("DOMContentLoaded", () => {
    const results = document.getElementById("search-results");
    const query = new URLSearchParams(window.location.search).get("q");
    if (!results || !query) return;
    const stemmer = new Stemmer();
    const stem = (word) => stemmer.stemWord(word);
    const words = wordsOf(query.toLowerCase()).map(([word]) => word);
    const stems = new Set(words.filter((word) => !stopwords.has(word)).map(stem));
    const look = () =>
      results.querySelectorAll("ul.search > li").forEach((item) => showExcerpt(item, stems, stem));
    new MutationObserver(look).observe(results, { childList: true, subtree: true });
    look();
  });
