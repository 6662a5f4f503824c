for (const button of document.querySelectorAll("nav button")) {
  button.onclick = () => {
    const only = button.dataset.only;
    for (const other of document.querySelectorAll("nav button")) other.classList.toggle("on", other === button);
    for (const section of document.querySelectorAll("section")) {
      for (const row of section.querySelectorAll("tbody tr")) row.hidden = only !== "all" && !row.classList.contains(only);
      section.hidden = only !== "all" && !section.querySelector("tbody tr:not([hidden])");
    }
    for (const part of document.querySelectorAll("h2.part")) {
      let next = part.nextElementSibling;
      while (next && next.tagName === "SECTION" && next.hidden) next = next.nextElementSibling;
      part.hidden = !next || next.tagName !== "SECTION";
    }
  };
}
for (const picture of document.querySelectorAll(".pictures img")) picture.onclick = () => picture.classList.toggle("large");
document.onkeydown = (event) => {
  if (event.key === "Escape") for (const picture of document.querySelectorAll("img.large")) picture.classList.remove("large");
};
