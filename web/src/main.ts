import "uplot/dist/uPlot.min.css";
import "./app.css";
import { mount } from "svelte";
import Gate from "./Gate.svelte";
import { preferences } from "./preferences.svelte";
import { theme } from "./theme.svelte";

theme.start();
preferences.start();

const target = document.getElementById("app");
if (!target) throw new Error("index.html has no #app");

mount(Gate, { target });
