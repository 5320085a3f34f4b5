"""What was found good before, with a key of all that it hung on: kept in a file of the build folder."""

import functools
import hashlib
import json
import os
import threading


class Stamps:
    def __init__(self, path):
        self.path = path
        self.keys = {}
        self.lock = threading.Lock()
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                self.keys = json.load(file)

    def is_good(self, name, key):
        return self.keys.get(name) == key

    def set(self, name, key):
        """That name is good with this key; None: that it is not."""
        with self.lock:
            self.keys[name] = key
            with open(self.path, "w", encoding="utf-8") as file:
                json.dump(self.keys, file, indent=1)


def key_of(words, paths):
    """Of words, and of the names and the contents of files; a folder stands for all files in it."""
    key = hashlib.sha256(json.dumps(words).encode())
    for path in paths:
        for file in files_in(path):
            key.update(file.encode() + content_key(file))
    return key.hexdigest()


def files_in(path):
    if not os.path.isdir(path):
        return [path]
    return sorted(os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names)


@functools.cache
def content_key(file):
    if not os.path.exists(file):
        return b"missing"
    with open(file, "rb") as content:
        return hashlib.sha256(content.read()).digest()
