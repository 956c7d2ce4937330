import { defineConfig } from "vite";

// The bundle is committed and embedded in the binary, so its files have fixed names and nothing in it depends on
// the machine or the day.
export default defineConfig({
  base: "./",
  build: {
    outDir: "../dist",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: false,
    chunkSizeWarningLimit: 900,
    rollupOptions: {
      output: {
        entryFileNames: "studio.js",
        chunkFileNames: "[name].js",
        assetFileNames: (asset) =>
          asset.names[0]?.endsWith(".css") ? "studio.css" : (asset.names[0] ?? "[name][extname]").replace("-latin-wght-normal", ""),
      },
    },
  },
  worker: {
    format: "es",
    rollupOptions: { output: { entryFileNames: "engine-worker.js" } },
  },
});
