/* A lamp and a line of text, then the program ends; its scenario ends soon after it. */
#include "simpletools.h"

int main() {
  high(26);
  pause(600);
  low(26);
  print("done\n");
  pause(300);
  high(26);
}
