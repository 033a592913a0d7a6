#include "board.h"
#include "motor.h"

wire_t bus;
channel_t left;

int main(void)
{
  board_init();
  bus = wire_open(2, 3, 0);
  while (1)
  {
    board_write(BOARD_LED, LEVEL_HIGH);
    OUT |= 1 << 4;
    motor_speed(0, 50);
    mystery(left.pin);
    while (TIMER < ticks_of(10)) ;
  }
}
