"""dirent.h, sys/stat.h, sys/unistd.h: folders of a card. Semantics of the sources of propgcc b280e7a77 (lib/misc)."""

from __future__ import annotations

from tests.adapters.bench import Uno, proves

FOLDERS = [
    "dirent.h/opendir", "dirent.h/readdir", "dirent.h/closedir", "sys/stat.h/mkdir", "sys/unistd.h/rmdir",
    "simpletools.h/sd_mount",
]  # fmt: skip
FILES = [f"stdio.h/{name}" for name in ("fopen", "fclose", "fprintf")]


@proves(*FOLDERS[:-1], beside=["simpletools.h/sd_mount", *FILES])
def folders_of_a_card_are_listed_made_and_taken_away(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void list(const char *path) { DIR *folder = opendir(path); if (!folder) { Serial.println("none"); return; }
  struct dirent *entry; while ((entry = readdir(folder))) { Serial.print(entry->d_name); Serial.print(' ');
    for (uint8_t letter : entry->name) Serial.print((char)letter);
    say(entry->attr); say(entry->filesize_0 + 256L * entry->filesize_1 + 65536L * entry->filesize_2); }
  say(closedir(folder)); Serial.println(); }
void setup() { Serial.begin(115200); say(opendir("/") != 0); sd_mount(12, 13, 11, 10); list("/"); FILE *f = fopen("log.txt", "w");
  c_fprintf(f, "hello %d", 12); c_fclose(f); say(mkdir("data", 0)); say(mkdir("data", 0)); say(mkdir("log.txt", 0)); list(".");
  list("log.txt"); list("nothing"); say(rmdir("log.txt")); say(rmdir("nothing")); say(rmdir("data")); list("./");
  say(closedir(0)); }
void loop() {}
"""
    told = uno.run(program, [*FOLDERS, *FILES, "dirent.h/dirent"], 200).text.splitlines()
    assert told[:2] == ["0 0 ", "0 -1 -1 log.txt log     txt32 8 data data       16 0 0 "]
    assert told[2:] == ["none", "none", "-1 -1 0 log.txt log     txt32 8 0 ", "-1 "]
