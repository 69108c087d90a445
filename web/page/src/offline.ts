// Where the page comes from a site, it stays in the browser, so that it opens again without a network.

export function keepOffline(): void {
  // A program on this machine is there without a network as well, and a file is.
  const own = ["localhost", "127.0.0.1", "[::1]", ""].includes(location.hostname);
  if (own || !isSecureContext || !("serviceWorker" in navigator)) return;
  // Without it the page works as before, and only not offline.
  navigator.serviceWorker.register("sw.js").catch(() => undefined);
}
