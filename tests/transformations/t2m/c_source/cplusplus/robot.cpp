#include <Servo.h>
#include <iostream>
extern "C" { void low_level(int); }
namespace robot {
template <typename T> T clamp(T v, T lo, T hi) { return v < lo ? lo : v; }
class Base { public: virtual ~Base() {} virtual void act(int n) = 0; };
class Wheel : public Base {
public:
  explicit Wheel(int pin) : pin_(pin) { servo_.attach(pin); }
  void act(int n) override { servo_.write(clamp(n, 0, 180)); for (int i : list_) go(i); }
  int operator[](int i) const { return list_[i]; }
private:
  int pin_; int list_[3]; Servo servo_;
};
enum class Mode : unsigned char { idle, run };
}
template <int N> struct Buffer { int data[N]; void clear() { memset(data, 0, sizeof data); } };
void helper(int x);
int later(int);
robot::Wheel wheel(3);
Servo other(4);
Buffer<4> buffer;
void setup() {
  Serial.begin(9600);
  pinMode(13, OUTPUT);
  wheel.act(90);
  robot::Wheel *p = new robot::Wheel(read_pin(2));
  p->act(static_cast<int>(analogRead(A0)));
  delete p;
  helper(later(1));
  buffer.clear();
  auto f = [](int a) { high(a); };
  try { f(wheel[1]); } catch (...) { low(3); }
  std::cout << "x" << later(2) << std::endl;
}
void helper(int x) { digitalWrite(x, HIGH); }
int later(int y) { return int(y * 2.0); }
