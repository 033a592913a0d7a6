/* Line follower for the Propeller Activity Bot: two QTI sensors look at the floor, two servos drive, a LED marks a
   checkpoint. A dark floor lets the sensor's capacitor decay slowly, a light one fast. */
#include "simpletools.h"   // Include simple tools
#include "abdrive.h"       // ActivityBot drive

const int leftQTI  = 6;    // Left QTI port
const int rightQTI = 7;    // Right QTI port
const int LED      = 8;    // LED port
const int QTI_T    = 50;   // QTI sensor threshold, in polls of 20 us
const int waitTime = 230;  // QTI charging time in us, 80 clock ticks each

// Charge the sensor, release it, and count how long it takes to decay
long GetQTIState(int comPort) {
  long state = 0;
  set_output(comPort, 0b1);
  set_direction(comPort, 0b1);
  waitcnt(CNT + waitTime * 80);
  set_direction(comPort, 0b0);
  while (get_state(comPort) == 1 && state < 2 * QTI_T) {
    waitcnt(CNT + 1600);
    state++;
  }
  return state;
}

int main() {
  while (1) {
    long sLeft  = GetQTIState(leftQTI);
    long sRight = GetQTIState(rightQTI);

    if (sLeft < QTI_T && sRight < QTI_T)
      drive_speed(24, 24);   // continue straight
    else if (sLeft < QTI_T && sRight > QTI_T)
      drive_speed(24, 12);   // turn
    else if (sLeft > QTI_T && sRight > QTI_T) {
      drive_speed(0, 0);     // stop
      high(LED);             // switch on LED
      pause(1000);           // wait 1 s
      low(LED);              // switch off LED
      drive_speed(24, 24);   // continue
    }
  }
}
