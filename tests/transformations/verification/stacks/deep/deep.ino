// Each kind of code that takes stack: frames below and above 256 bytes, calls through pointers and tables of virtual functions,
// the branches of a switch, arguments that are pushed, functions of the C library, and interrupts.
#include <stdio.h>

volatile int chosen = 3;
volatile uint8_t seen;

__attribute__((noinline)) int small(int value) {
  volatile char room[30];
  for (unsigned at = 0; at < sizeof room; at++) room[at] = value;
  return room[7];
}

__attribute__((noinline)) int large(int value) {
  volatile char room[300];
  for (unsigned at = 0; at < sizeof room; at++) room[at] = value;
  return room[value] + small(value);
}

__attribute__((noinline)) int text(int value) {
  char said[12];
  sprintf(said, "%d %c", value, 'x');
  return said[0];
}

int (*volatile called)(int);

struct Shape {
  virtual int of(int value) = 0;
};
struct Inner : Shape {
  int of(int value) override { return small(value) + 1; }
};
struct Outer : Shape {
  int of(int value) override { return text(value) + 2; }
};
Inner inner_shape;
Outer outer_shape;
Shape *volatile shape;

__attribute__((noinline)) int branch(int which) {
  switch (which) {
    case 0: return small(1);
    case 1: return large(2);
    case 2: return text(3);
    case 3: return called(4);
    case 4: return shape->of(5);
    case 5: return small(text(6));
    default: return 0;
  }
}

void setup() {
  Serial.begin(9600);
  shape = chosen > 2 ? (Shape *)&outer_shape : (Shape *)&inner_shape;
  called = chosen > 2 ? large : small;
  for (int which = 0; which < 7; which++) seen += branch(which);
  Serial.print(seen);
}

void loop() {}
