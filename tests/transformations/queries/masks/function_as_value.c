// ports ?
#include "simpletools.h"
void light(int number) {
  OUTA |= 1 << number;
}
void (*called)(int) = light;

int main() {
  light(3);
  called(5);
}
