#include "simpletools.h"

int first[2] = {5, 6};
void other(int *numbers, int turns);
void one(int *numbers, int turns) { if (turns) other(numbers, turns - 1); }
void other(int *numbers, int turns) {
  if (turns) one(numbers, turns - 1);
  numbers[0] = 9;
}
int second[2] = {3, 4}, third[2] = {7, 8};

int main() {
  other(first, 1);
  one(second, 2);
  print("%d\n", third[0]);
}
