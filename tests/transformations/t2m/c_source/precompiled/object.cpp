#include "motor.h"
class Robot { public: Robot(int pin) : pin(pin) {} void stop() { STOP(); } private: int pin; };
int main() { Robot robot(LED); robot.stop(); return get_input(SPEED); }
