/* Commands for a lamp, looked up in a text that was read, until "stop". */
#include "simpletools.h"

char line[40];

int main() {
  int level, ms;
  char word[12];
  low(7);
  terminal_setEcho(simpleterm_pointer(), 1);
  while (1) {
    getStr(line, 39);
    sscan(line, "%s", word);
    if (!strcmp(word, "stop")) break;
    if (!strcmp(word, "lamp")) {
      int n = sscan(line, "lamp %d for %d", &level, &ms);
      set_output(7, level);
      if (n == 2) {
        pause(ms);
        low(7);
      }
    } else {
      sscanAfterStr(line, "=", "%d", &ms);
      print("%d?\n", ms);
    }
  }
  print("%d", terminal_checkEcho(simpleterm_pointer()));
}
