/* What is typed is told in capitals. */
#include "simpletools.h"

int main() {
  while (1) {
    char c = getChar();
    if (c >= 'a' && c <= 'z') c -= 32;
    print("<%c>\n", c);
  }
}
