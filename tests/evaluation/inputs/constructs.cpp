#include "simpletools.h"
#define LIMIT 3
namespace robot { const int LAMP = 8; void blink(int pin) { high(pin); low(pin); } }
using robot::blink;
using Port = int;
typedef unsigned int Ticks;
enum Mode { IDLE, RUN };
enum class Side : int { left, right };
struct Pair { int a, b; };
union Word { int all; char bytes[4]; };
class Part {
 public:
  explicit Part(int pin = 2) : pin_(pin), state_{0} {}
  virtual ~Part() {}
  virtual void on() const { high(pin_); }
  static int made;
  int operator()(int x) const { return x + pin_; }
 protected:
  int pin_;
  int state_;
};
int Part::made = 0;
class Lamp : public Part {
 public:
  Lamp(int pin) : Part(pin) {}
  void on() const override { low(pin_); }
  friend int peek(const Lamp &lamp);
};
int peek(const Lamp &lamp) { return lamp.pin_; }
template <typename T, int N> T sum(const T (&values)[N]) { T all = 0; for (T value : values) all += value; return all; }
int twice(int x) { return 2 * x; }
double twice(double x) { return 2 * x; }
constexpr int SQUARE = LIMIT * LIMIT;
int main() {
  Lamp lamp(robot::LAMP);
  Part *part = new Lamp{4};
  auto add = [&](int x) { return x + SQUARE; };
  const int numbers[] = {1, 2, 3};
  Pair pair = {1, 2};
  int &first = pair.a;
  bool go = true;
  switch (numbers[0]) { case 1: first++; break; default: first--; }
  do { first = static_cast<int>(sizeof(pair)) > 4 ? add(1) : ~first; } while (first < 0);
  for (int i = 0; i < LIMIT; i++) { if (i == 2) continue; blink(i); }
  while (go) { lamp.on(); part->on(); pause(twice(10)); go = sum(numbers) > 0 && Side::left != Side::right; }
  delete part;
  return 0;
}
