// Keeps the page: the newest where there is a network, and the last one where there is none.

const KEPT = "adsdv";

addEventListener("install", (event) => {
  event.waitUntil(caches.open(KEPT).then((cache) => cache.add("./")).then(() => skipWaiting()));
});
addEventListener("activate", (event) => event.waitUntil(clients.claim()));
addEventListener("fetch", (event) => {
  if (event.request.mode !== "navigate") return;
  event.respondWith((async () => {
    const cache = await caches.open(KEPT);
    try {
      const fresh = await fetch(event.request);
      if (fresh.ok) await cache.put("./", fresh.clone());
      return fresh;
    } catch {
      return (await cache.match("./")) ?? Response.error();
    }
  })());
});
