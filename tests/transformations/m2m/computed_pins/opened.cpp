// A line that ends with a question mark uses a port that only a run shows.
#include "simpletools.h"
#include <string.h>

struct Base { int base; };
struct Cleared : Base {
  int pin;
  void clear() { memset(this, 0, sizeof *this); }
};
struct Named { int pin; } named = {4};
struct Member { int pin, other; } member = {5, 6};
struct More { int more; int operator()(int pin) const { high(pin + more); return 0; } }; // ?

template <class F> void each(F use) {
  use(7);
}

int main() {
  Cleared cleared;
  cleared.base = 8;
  cleared.clear();
  high(cleared.base); // ?
  *reinterpret_cast<int *>(&named) = 9;
  high(named.pin); // ?
  int Member::*at = &Member::pin;
  member.*at = 10;
  high(member.pin); // ?
  int first = 11, second = 12, list[2] = {13, 14};
  auto change = [&own = first, copy = second](int by) { own += by + copy; };
  change(1);
  high(first + 1); // ?
  auto fill = [&element = list[1]] { element = 15; };
  fill();
  high(list[1] + 1); // ?
  each(More{2});
  each([](int pin) { low(pin); });
}
