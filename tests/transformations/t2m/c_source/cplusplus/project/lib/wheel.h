extern "C" void tick(void);
class Wheel {
public:
  Wheel(int pin);
  void turn(int step);
private:
  int pin_;
};
