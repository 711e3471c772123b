#!/usr/bin/python3
"""serve.py FOLDER COMMAND...: serves a folder on this machine while a command runs, and replaces {url} in its words by the
address. As servers of rasters do, it answers with the ranges of bytes that it is asked for, and says when a file was
changed. How many ranges were asked for goes to stderr. Ends with the status of the command."""
import functools
import http.server
import os
import re
import subprocess
import sys
import threading


class Handler(http.server.SimpleHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    ranges = 0  # that were asked for

    def log_message(self, *_):
        pass

    def do_GET(self):
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        path = self.translate_path(self.path)
        if not wanted or not os.path.isfile(path):
            super().do_GET()
            return
        Handler.ranges += 1
        size = os.path.getsize(path)
        first, last = int(wanted[1]), min(int(wanted[2]), size - 1)
        if first > last:
            self.send_error(416)
            return
        with open(path, "rb") as file:
            file.seek(first)
            content = file.read(last + 1 - first)
        self.send_response(206)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        self.send_header("Last-Modified", self.date_time_string(os.path.getmtime(path)))
        self.end_headers()
        self.wfile.write(content)


def main():
    folder, *command = sys.argv[1:]
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = f"http://127.0.0.1:{server.server_address[1]}"
    environment = {name: value for name, value in os.environ.items() if not name.lower().endswith("_proxy")}
    status = subprocess.run([word.replace("{url}", url) for word in command], env=environment).returncode
    server.shutdown()
    print(f"{Handler.ranges} ranges of bytes", file=sys.stderr)
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main())
