// A line that ends with a question mark uses a port that only a run shows.
#include "simpletools.h"
#include <string.h>

struct cleared { int pin, other; } cleared = {3, 4};
struct inner { int pin; };
struct outer { struct inner in; int other; } outer = {{5}, 6};
struct copied { int pin, other; } copied = {7, 8};
struct alike { int pin, other; } alike = {9, 10}, same = {11, 12};
struct walked { int pin, other; } walked = {13, 14};
struct given { int pin, other; } given = {15, 16};
struct handed { int pin, other; } handed = {17, 18};
struct started { int pin, other; } started = {19, 20};
struct made { int pin, other; };
struct bits { int mask; } bits = {1 << 21};
union parts { unsigned whole; unsigned char part[4]; } parts = {1 << 22};
struct listed { int mask; } listed = {1 << 23};

int words[2] = {24, 25};
unsigned char raw[8] __attribute__((aligned(4)));
int stack[50];

void clear(void *thing, int size) {
  char *each = thing;
  while (size--)
    *each++ = 0;
}

void blink(void *thing) {
  struct started *own = thing;
  high(own->pin);
}

int main() {
  memset(&cleared, 0, sizeof cleared);
  high(cleared.pin); // ?
  memset(&outer, 0, sizeof outer);
  high(outer.in.pin); // ?
  memcpy(&copied, words, sizeof copied);
  high(copied.pin); // ?
  memcpy(&alike, &same, sizeof alike);
  high(alike.pin);
  int *place = &walked.pin;
  place[1] = 26;
  high(walked.other); // ?
  void *unknown = &given;
  int *number = unknown;
  number[1] = 27;
  high(given.other); // ?
  clear(&handed, sizeof handed);
  high(handed.pin); // ?
  cogstart(blink, &started, stack, sizeof stack);
  high(started.other);
  struct made *made = (struct made *)raw;
  made->pin = 2;
  raw[0] = 1;
  high(made->pin); // ?
  memset(&bits, 1, sizeof bits);
  DIRA |= bits.mask; // ?
  parts.part[1] = 4;
  DIRA |= parts.whole; // ?
  listed = (struct listed){1 << 6};
  DIRA |= listed.mask;
}
