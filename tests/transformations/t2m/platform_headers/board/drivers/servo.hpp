#pragma once
namespace drivers {
enum class Side { left, right };
class Servo {
public:
  explicit Servo(int pin);
  void write(int angle);
  int read() const;
private:
  int pin_;
};
void center(Servo &servo);
}
