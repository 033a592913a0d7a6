#pragma once

struct Kept { unsigned char DDRB; };

inline void flash_all()
{
#ifdef __AVR__
  PORTB |= 0x20;
#else
  digitalWrite(LED_BUILTIN, HIGH);
#endif
}
