"use strict";

// a diagram is drawn before it is seen: drawing all at once would keep the page from answering
function draw(figure) {
  const data = figure.querySelector("script");
  if (!data || figure.dataset.drawn) return;
  figure.dataset.drawn = "yes";
  Chart.draw(figure, JSON.parse(data.textContent));
}

const diagrams = [...document.querySelectorAll(".diagram")];
const coming = new IntersectionObserver(seen => seen.filter(one => one.isIntersecting).forEach(one => draw(one.target)), {rootMargin: "800px"});
for (const figure of diagrams) coming.observe(figure);
window.addEventListener("beforeprint", () => diagrams.forEach(draw));

for (const section of document.querySelectorAll(".claims")) {
  const filter = () => {
    const shown = new Set([...section.querySelectorAll("input[data-verdict]:checked")].map(box => box.dataset.verdict));
    const words = section.querySelector(".words").value.toLowerCase().split(/\s+/).filter(word => word);
    for (const row of section.querySelectorAll("tbody tr")) {
      const text = row.textContent.toLowerCase();
      row.hidden = !shown.has(row.dataset.verdict) || !words.every(word => text.includes(word));
    }
  };
  section.addEventListener("input", filter);
  filter();  // a browser keeps what was chosen before the page was loaded again
}
