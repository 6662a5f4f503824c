for (const button of document.querySelectorAll("nav button")) {
  button.onclick = () => {
    const only = button.dataset.only;
    for (const other of document.querySelectorAll("nav button")) other.classList.toggle("on", other === button);
    for (const row of document.querySelectorAll("tbody tr")) row.hidden = only !== "all" && !row.classList.contains(only);
    for (const section of document.querySelectorAll("section")) section.hidden = !section.querySelector("tbody tr:not([hidden])") && only !== "all";
  };
}
for (const picture of document.querySelectorAll(".pictures img")) picture.onclick = () => picture.classList.toggle("large");
