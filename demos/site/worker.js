// Search where the site is read from files: browsers start no worker and fetch no index there, so the same code runs in a hidden frame,
// and the index is a script. Behind a server nothing is changed.
if (location.protocol === "file:") {
    document.write(`<script src="${new URL("../search/search_index.js", document.currentScript.src)}"><\/script>`);
    window.Worker = class {
        constructor(url) {
            this.listeners = [];
            this.waiting = [];
            const frame = document.createElement("iframe");
            frame.hidden = true;
            frame.srcdoc = `<script>
                const handlers = [];
                window.addEventListener("message", (event) => handlers.forEach((handler) => handler({ data: event.data })));
                const own = window.addEventListener.bind(window);
                window.addEventListener = (kind, handler) => (kind === "message" ? handlers.push(handler) : own(kind, handler));
                window.importScripts = (...urls) => Promise.all(urls.map((url) => new Promise((done, failed) => {
                    const script = document.createElement("script");
                    Object.assign(script, { src: url, onload: done, onerror: failed });
                    document.head.append(script);
                })));
                window.postMessage = (data) => parent.dispatchEvent(new MessageEvent("scree-search", { data }));
            <\/script><script src="${url}"><\/script>`;
            frame.addEventListener("load", () => {
                this.frame = frame;
                this.waiting.splice(0).forEach((data) => this.postMessage(data));
            });
            window.addEventListener("scree-search", (event) => this.tell(event.data));
            document.documentElement.append(frame);
        }
        addEventListener(kind, listener) {
            if (kind === "message") this.listeners.push(listener);
        }
        removeEventListener(kind, listener) {
            this.listeners = this.listeners.filter((one) => one !== listener);
        }
        tell(data) {
            const event = new MessageEvent("message", { data });
            this.listeners.forEach((listener) => listener(event));
            if (this.onmessage) this.onmessage(event);
        }
        postMessage(data) {
            if (!this.frame) return void this.waiting.push(data);
            this.frame.contentWindow.dispatchEvent(new MessageEvent("message", { data }));
        }
    };
}
