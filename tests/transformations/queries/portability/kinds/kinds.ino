#include <avr/wdt.h>          // avr_include
#include <avr/pgmspace.h>
#include <Servo.h>            // servo
#include <EEPROM.h>           // eeprom
#include <SoftwareSerial.h>   // software_serial
#include "lamp.h"

struct Reading { int value; double scale; };
extern int __heap_start, *__brkval;          // free_ram
const int statusLed = 13;                    // pin_13
const int buzzerPin = 13;
#define BUTTON 15                            // analog_pin_as_14_to_19
const byte table[] PROGMEM = {1, 2, 3};      // progmem
#define RESTART() asm("jmp 0")               // inline_asm
Servo arm;                                   // servo
Servo *other = &arm;
SoftwareSerial radio(2, 3);                  // software_serial
Lamp lamp(buzzerPin);
Reading reading;
char text[8], copy[8];
volatile int count;
void (*restart)() = 0;
void (*later)() = 0;

void counted() { count++; }
ISR(TIMER1_COMPA_vect) { count++; }          // isr_vector

void setup() {
  DDRB |= 1;                                 // port_register
  TCCR1B = _BV(CS12);                        // timer_register avr_libc_call
  ADMUX = 0;                                 // adc_register
  PCICR |= 1;                                // other_register
  wdt_reset();                               // avr_libc_call
  pinMode(statusLed, OUTPUT);
  pinMode(13, OUTPUT);                       // pin_13
  pinMode(BUTTON, INPUT);
  attachInterrupt(0, counted, RISING);       // attach_interrupt_number
  attachInterrupt(digitalPinToInterrupt(2), counted, RISING);
  EEPROM.put(0, reading);                    // eeprom bytes_of_object
  memcpy(&reading, text, sizeof(reading));   // bytes_of_object
  memcpy(copy, text, sizeof(text));
  int since = millis();                      // int_time
  long now = millis();
  count = sizeof(int) + since + now;         // sizeof_int
#ifdef __AVR_ATmega2560__                    // board_macro
  TCCR5B = 0;                                // timer_register
#endif
}

void loop() {
  count = analogRead(0) + analogRead(A1);    // analog_pin_number
  count += analogRead(A5);                   // analog_pin_above_A3
  tone(8, pgm_read_byte(&table[0]));         // tone progmem
  *portOutputRegister(digitalPinToPort(8)) = 0; // pin_register
  count = F_CPU / 1000000L;                  // clock_macro
  count = NUM_DIGITAL_PINS;                  // pin_count
  count = INT_MAX;                           // int_limit
  later = counted;
  later();
  restart();                                 // call_of_null
  Serial.println(F("PORTB sei() EEPROM.read tone(1)"));
}
