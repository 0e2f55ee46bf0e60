import { defineConfig } from "vite";

export default defineConfig({
  base: "./",
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  build: {
    outDir: "../src/usd2kg/endpoint/app",
    emptyOutDir: true,
    // The content policy of the server forbids inline scripts and data: scripts.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
    // The studio, and the query page of usd2kg serve.
    rollupOptions: { input: ["index.html", "query.html"] },
    target: "es2022",
    // The licences of the libraries in the bundle ship beside it.
    license: { fileName: "licenses.md" },
  },
  server: { proxy: { "/api": "http://127.0.0.1:7879" } },
});
