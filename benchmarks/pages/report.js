"use strict";

for (const figure of document.querySelectorAll(".diagram")) {
  const data = figure.querySelector("script");
  if (data) Chart.draw(figure, JSON.parse(data.textContent));
}

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
