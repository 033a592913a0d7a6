// bytes: 24 + 9
#include "simpletools.h"
#include "datetime.h"

datetime now = {2015, 10, 23, 9, 36, 27};  // 24: six numbers of 4 bytes
char text[9];

int main() {
  dt_run(now);
  while (1) {
    now = dt_get();
    dt_toTimeStr(now, text);
    print("%s\n", text);
  }
}
