// What nobody can bound: a function that calls itself, and a frame whose size is computed.
#include <alloca.h>

volatile int depth = 4;

__attribute__((noinline)) int again(int left) {
  volatile char room[8];
  room[left & 7] = left;
  return left > 0 ? again(left - 1) + room[left & 7] : 0;
}

__attribute__((noinline)) int computed(int size) {
  volatile char *room = (volatile char *)alloca(size);
  for (int at = 0; at < size; at++) room[at] = at;
  return room[size / 2];
}

void setup() {
  depth = again(depth) + computed(depth + 20);
}

void loop() {}
