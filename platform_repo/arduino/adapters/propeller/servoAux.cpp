//# header servoAux.h
// Servos with pulses in the background, as of servo.h. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Motor/libservoAux.
// Its servos are those of servo.h here: a pin that both are told of is one servo.

//# adapter servoAux_set
//#   for: int servoAux_set(int pin, int time)
//#   kind: oneToOne
//#   needs: servo.h/servo_set
//#   pin: pin digital out servo
//#   fidelity: as servo_set: widths within 1 us; the pin at the first call, 1 later, -3 without a free place, as there
//#   limit avr: 12 servos at a time instead of 14, but 14 on a Mega; no PWM on pins 9 and 10 of an Uno, or 44 to 46 of a Mega
//#   limit rp2040: 8 servos at a time instead of 14
//#   limit other: 8 servos at a time instead of 14
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servoAux_set(int32_t pin, int32_t time) {
  return servo_set(pin, time);
}

//# adapter servoAux_angle
//#   for: int servoAux_angle(int pin, int degreeTenths)
//#   kind: oneToOne
//#   needs: servoAux_set
//#   pin: pin digital out servo
//#   fidelity: 500 us and one more for each tenth of a degree, as there
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servoAux_angle(int32_t pin, int32_t degreeTenths) {
  return servoAux_set(pin, degreeTenths + 500);
}

//# adapter servoAux_speed
//#   for: int servoAux_speed(int pin, int speed)
//#   kind: oneToOne
//#   needs: servo.h/servo_speed
//#   pin: pin digital out servo
//#   fidelity: 1,500 us and one more for each unit, as there, or by the table of the servo in robosmi.toml
//#   stack: 38 22
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servoAux_speed(int32_t pin, int32_t speed) {
  return servo_speed(pin, speed);
}

//# adapter servoAux_get
//#   for: int servoAux_get(int pin)
//#   kind: oneToOne
//#   needs: servo.h/servo_get
//#   pin: pin digital out servo
//#   fidelity: the width last sent in microseconds, on the way of a ramp too; -4 for a pin without a servo
//#   stack: 0
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servoAux_get(int32_t pin) {
  return servo_get(pin);
}

//# adapter servoAux_setRamp
//#   for: int servoAux_setRamp(int pin, int stepSize)
//#   kind: oneToOne
//#   needs: servo.h/servo_setramp
//#   pin: pin digital out servo
//#   fidelity: at most so many microseconds more or less every 20 ms; -4 for a pin without a servo
//#   stack: 2 0
//#   interrupt: TIMER0_COMPA_vect 46 46
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER1_COMPB_vect 21 21
inline int32_t servoAux_setRamp(int32_t pin, int32_t stepSize) {
  return servo_setramp(pin, stepSize);
}

//# adapter servoAux_disable
//#   for: int servoAux_disable(int pin)
//#   kind: oneToOne
//#   needs: servoAux_set
//#   pin: pin digital out servo
//#   fidelity: what its header says: the pin becomes an input; the library's source has no body for it
//#   stack: 22 14
//#   interrupt: TIMER1_COMPA_vect 21
inline int32_t servoAux_disable(int32_t pin) {
  return servoAux_set(pin, 0);
}

//# adapter servoAux_stop
//#   for: void servoAux_stop(void)
//#   kind: oneToOne
//#   needs: servo.h/servo_stop
//#   fidelity: all pulses end and the pins become inputs; they go on with the next call of servoAux_set and its like, as there
//#   stack: 24 14
//#   interrupt: TIMER1_COMPA_vect 21
inline void servoAux_stop() {
  servo_stop();
}
