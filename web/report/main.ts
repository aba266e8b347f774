import { readData } from "../shared/data";

const root = document.getElementById("report");
if (root) root.textContent = JSON.stringify(readData(), null, 1);
