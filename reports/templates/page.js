// The page works without this. A link into a folded part opens it; a narrow screen starts with the
// contents folded.
function unfold() {
  const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
  if (!target) return;
  let folded = false;
  for (let e = target; e; e = e.parentElement)
    if (e.tagName === "DETAILS" && !e.open) e.open = folded = true;
  if (folded) target.scrollIntoView();
}
addEventListener("hashchange", unfold);
unfold();
const contents = document.querySelector(".contents details");
if (contents && matchMedia("(max-width: 70rem)").matches) contents.open = false;
