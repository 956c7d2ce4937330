// Starting the browser, for the suite and for making pictures.

import { chromium } from "playwright-core";

/** Debian's browser, without anything that goes over the network by itself. */
export function launch() {
  return chromium.launch({
    executablePath: process.env.HRAY_CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      // A page that the suite answers for itself counts as one of the web, which may not reach this machine.
      ...(process.env.HRAY_PAGE ? ["--disable-features=LocalNetworkAccessChecks"] : []),
    ],
  });
}
