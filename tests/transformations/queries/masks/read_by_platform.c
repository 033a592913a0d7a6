// ports ?
#include "simpletools.h"
int chosen = 4;

int main() {
  scan("%d", &chosen);
  OUTA |= 1 << chosen;
}
