#include "simpletools.h"

template <class T> T larger(T a, T b) { return a > b ? a : b; }
template <class T> T twice(T a, int times) { return a * times; }
template <int N> int more(int a) { return a + N; }
template <class T> struct Box {
  T v;
  Box(T x) : v(x) {}
  template <class U> U addup(U other) { return v + other; }
};
enum class Speed { slow, fast };
auto total() { return 300; }                             // becomes: return 300L;
auto same(int a) -> decltype(a) { return 300; }          // becomes: { return 300; }
struct Step { int n; int operator++(int) { return n++; } };  // becomes: { int32_t n; int32_t operator++(int) {
Speed operator--(Speed &s, int) { return s; }            // stays
struct Arm { auto reach() const { return 200; } };       // becomes: return 200L;

int n = 3;
short s = 3;
char c = 'c';

int main() {
  int t = larger(n, 10);                                 // becomes: larger(n, 10L)
  t += twice(20000, 2);                                  // becomes: twice(20000L, 2)
  t += more<2>(7);                                       // stays
  t += larger(s, s);                                     // stays
  t += Box<int>(1).addup(30000);                           // becomes: addup(30000L)
  auto k = 300;                                          // becomes: k = 300L
  const auto u = 40000u;                                 // becomes: u = 40000uL
  auto narrow = s;                                       // stays
  auto letter = c;                                       // stays
  auto speed = Speed::fast;                              // stays
  for (auto i = 32766; i < 32770; i++) t += i;           // becomes: i = 32766L
  auto sign = [](int a) { if (a < 0) return -1; return a; };  // becomes: return -1L;
  auto scaled = [k = 300](int a) { return k * a; };      // becomes: [k = 300L](int32_t a) { return k * a; }
  auto on = [](int a) -> bool { return 1; };             // becomes: { return 1; }
  return t + k + u + narrow + letter + (speed == Speed::fast) + sign(t) + on(t) + scaled(t) + total() + same(t) + Arm().reach() + Step{1}++;
}
