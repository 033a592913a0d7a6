/* Registers, bits and interrupt vectors of the ATmega2560 (avr-libc 2.0, avr/iomxx0_1.h): names, widths, numbers. */
extern volatile uint8_t ACSR;
extern volatile uint16_t ADC;
extern volatile uint8_t ADCH;
extern volatile uint8_t ADCL;
extern volatile uint8_t ADCSRA;
extern volatile uint8_t ADCSRB;
extern volatile uint16_t ADCW;
extern volatile uint8_t ADMUX;
extern volatile uint8_t ASSR;
extern volatile uint8_t AVR_EXTENDED_INDIRECT_REG;
extern volatile uint8_t AVR_RAMPZ_REG;
extern volatile uint8_t AVR_STACK_POINTER_HI_REG;
extern volatile uint8_t AVR_STACK_POINTER_LO_REG;
extern volatile uint16_t AVR_STACK_POINTER_REG;
extern volatile uint8_t AVR_STATUS_REG;
extern volatile uint8_t CLKPR;
extern volatile uint8_t DDRA;
extern volatile uint8_t DDRB;
extern volatile uint8_t DDRC;
extern volatile uint8_t DDRD;
extern volatile uint8_t DDRE;
extern volatile uint8_t DDRF;
extern volatile uint8_t DDRG;
extern volatile uint8_t DDRH;
extern volatile uint8_t DDRJ;
extern volatile uint8_t DDRK;
extern volatile uint8_t DDRL;
extern volatile uint8_t DIDR0;
extern volatile uint8_t DIDR1;
extern volatile uint8_t DIDR2;
extern volatile uint16_t EEAR;
extern volatile uint8_t EEARH;
extern volatile uint8_t EEARL;
extern volatile uint8_t EECR;
extern volatile uint8_t EEDR;
extern volatile uint8_t EICRA;
extern volatile uint8_t EICRB;
extern volatile uint8_t EIFR;
extern volatile uint8_t EIMSK;
extern volatile uint8_t EIND;
extern volatile uint8_t GPIOR0;
extern volatile uint8_t GPIOR1;
extern volatile uint8_t GPIOR2;
extern volatile uint8_t GTCCR;
extern volatile uint16_t ICR1;
extern volatile uint8_t ICR1H;
extern volatile uint8_t ICR1L;
extern volatile uint16_t ICR3;
extern volatile uint8_t ICR3H;
extern volatile uint8_t ICR3L;
extern volatile uint16_t ICR4;
extern volatile uint8_t ICR4H;
extern volatile uint8_t ICR4L;
extern volatile uint16_t ICR5;
extern volatile uint8_t ICR5H;
extern volatile uint8_t ICR5L;
extern volatile uint8_t MCUCR;
extern volatile uint8_t MCUSR;
extern volatile uint8_t MONDR;
extern volatile uint8_t OCDR;
extern volatile uint8_t OCR0A;
extern volatile uint8_t OCR0B;
extern volatile uint16_t OCR1A;
extern volatile uint8_t OCR1AH;
extern volatile uint8_t OCR1AL;
extern volatile uint16_t OCR1B;
extern volatile uint8_t OCR1BH;
extern volatile uint8_t OCR1BL;
extern volatile uint16_t OCR1C;
extern volatile uint8_t OCR1CH;
extern volatile uint8_t OCR1CL;
extern volatile uint8_t OCR2A;
extern volatile uint8_t OCR2B;
extern volatile uint16_t OCR3A;
extern volatile uint8_t OCR3AH;
extern volatile uint8_t OCR3AL;
extern volatile uint16_t OCR3B;
extern volatile uint8_t OCR3BH;
extern volatile uint8_t OCR3BL;
extern volatile uint16_t OCR3C;
extern volatile uint8_t OCR3CH;
extern volatile uint8_t OCR3CL;
extern volatile uint16_t OCR4A;
extern volatile uint8_t OCR4AH;
extern volatile uint8_t OCR4AL;
extern volatile uint16_t OCR4B;
extern volatile uint8_t OCR4BH;
extern volatile uint8_t OCR4BL;
extern volatile uint16_t OCR4C;
extern volatile uint8_t OCR4CH;
extern volatile uint8_t OCR4CL;
extern volatile uint16_t OCR5A;
extern volatile uint8_t OCR5AH;
extern volatile uint8_t OCR5AL;
extern volatile uint16_t OCR5B;
extern volatile uint8_t OCR5BH;
extern volatile uint8_t OCR5BL;
extern volatile uint16_t OCR5C;
extern volatile uint8_t OCR5CH;
extern volatile uint8_t OCR5CL;
extern volatile uint8_t OSCCAL;
extern volatile uint8_t PCICR;
extern volatile uint8_t PCIFR;
extern volatile uint8_t PCMSK0;
extern volatile uint8_t PCMSK1;
extern volatile uint8_t PCMSK2;
extern volatile uint8_t PINA;
extern volatile uint8_t PINB;
extern volatile uint8_t PINC;
extern volatile uint8_t PIND;
extern volatile uint8_t PINE;
extern volatile uint8_t PINF;
extern volatile uint8_t PING;
extern volatile uint8_t PINH;
extern volatile uint8_t PINJ;
extern volatile uint8_t PINK;
extern volatile uint8_t PINL;
extern volatile uint8_t PORTA;
extern volatile uint8_t PORTB;
extern volatile uint8_t PORTC;
extern volatile uint8_t PORTD;
extern volatile uint8_t PORTE;
extern volatile uint8_t PORTF;
extern volatile uint8_t PORTG;
extern volatile uint8_t PORTH;
extern volatile uint8_t PORTJ;
extern volatile uint8_t PORTK;
extern volatile uint8_t PORTL;
extern volatile uint8_t PRR0;
extern volatile uint8_t PRR1;
extern volatile uint8_t RAMPZ;
extern volatile uint8_t SMCR;
extern volatile uint16_t SP;
extern volatile uint8_t SPCR;
extern volatile uint8_t SPDR;
extern volatile uint8_t SPH;
extern volatile uint8_t SPL;
extern volatile uint8_t SPMCSR;
extern volatile uint8_t SPSR;
extern volatile uint8_t SREG;
extern volatile uint8_t TCCR0A;
extern volatile uint8_t TCCR0B;
extern volatile uint8_t TCCR1A;
extern volatile uint8_t TCCR1B;
extern volatile uint8_t TCCR1C;
extern volatile uint8_t TCCR2A;
extern volatile uint8_t TCCR2B;
extern volatile uint8_t TCCR3A;
extern volatile uint8_t TCCR3B;
extern volatile uint8_t TCCR3C;
extern volatile uint8_t TCCR4A;
extern volatile uint8_t TCCR4B;
extern volatile uint8_t TCCR4C;
extern volatile uint8_t TCCR5A;
extern volatile uint8_t TCCR5B;
extern volatile uint8_t TCCR5C;
extern volatile uint8_t TCNT0;
extern volatile uint16_t TCNT1;
extern volatile uint8_t TCNT1H;
extern volatile uint8_t TCNT1L;
extern volatile uint8_t TCNT2;
extern volatile uint16_t TCNT3;
extern volatile uint8_t TCNT3H;
extern volatile uint8_t TCNT3L;
extern volatile uint16_t TCNT4;
extern volatile uint8_t TCNT4H;
extern volatile uint8_t TCNT4L;
extern volatile uint16_t TCNT5;
extern volatile uint8_t TCNT5H;
extern volatile uint8_t TCNT5L;
extern volatile uint8_t TIFR0;
extern volatile uint8_t TIFR1;
extern volatile uint8_t TIFR2;
extern volatile uint8_t TIFR3;
extern volatile uint8_t TIFR4;
extern volatile uint8_t TIFR5;
extern volatile uint8_t TIMSK0;
extern volatile uint8_t TIMSK1;
extern volatile uint8_t TIMSK2;
extern volatile uint8_t TIMSK3;
extern volatile uint8_t TIMSK4;
extern volatile uint8_t TIMSK5;
extern volatile uint8_t TWAMR;
extern volatile uint8_t TWAR;
extern volatile uint8_t TWBR;
extern volatile uint8_t TWCR;
extern volatile uint8_t TWDR;
extern volatile uint8_t TWSR;
extern volatile uint16_t UBRR0;
extern volatile uint8_t UBRR0H;
extern volatile uint8_t UBRR0L;
extern volatile uint16_t UBRR1;
extern volatile uint8_t UBRR1H;
extern volatile uint8_t UBRR1L;
extern volatile uint16_t UBRR2;
extern volatile uint8_t UBRR2H;
extern volatile uint8_t UBRR2L;
extern volatile uint16_t UBRR3;
extern volatile uint8_t UBRR3H;
extern volatile uint8_t UBRR3L;
extern volatile uint8_t UCSR0A;
extern volatile uint8_t UCSR0B;
extern volatile uint8_t UCSR0C;
extern volatile uint8_t UCSR1A;
extern volatile uint8_t UCSR1B;
extern volatile uint8_t UCSR1C;
extern volatile uint8_t UCSR2A;
extern volatile uint8_t UCSR2B;
extern volatile uint8_t UCSR2C;
extern volatile uint8_t UCSR3A;
extern volatile uint8_t UCSR3B;
extern volatile uint8_t UCSR3C;
extern volatile uint8_t UDR0;
extern volatile uint8_t UDR1;
extern volatile uint8_t UDR2;
extern volatile uint8_t UDR3;
extern volatile uint8_t WDTCSR;
extern volatile uint8_t XMCRA;
extern volatile uint8_t XMCRB;
#define ACBG 6
#define ACD 7
#define ACI 4
#define ACIC 2
#define ACIE 3
#define ACIS0 0
#define ACIS1 1
#define ACME 6
#define ACO 5
#define ADATE 5
#define ADC0D 0
#define ADC10D 2
#define ADC11D 3
#define ADC12D 4
#define ADC13D 5
#define ADC14D 6
#define ADC15D 7
#define ADC1D 1
#define ADC2D 2
#define ADC3D 3
#define ADC4D 4
#define ADC5D 5
#define ADC6D 6
#define ADC7D 7
#define ADC8D 0
#define ADC9D 1
#define ADEN 7
#define ADIE 3
#define ADIF 4
#define ADLAR 5
#define ADPS0 0
#define ADPS1 1
#define ADPS2 2
#define ADSC 6
#define ADTS0 0
#define ADTS1 1
#define ADTS2 2
#define AIN0D 0
#define AIN1D 1
#define AS2 5
#define BORF 2
#define CLKPCE 7
#define CLKPS0 0
#define CLKPS1 1
#define CLKPS2 2
#define CLKPS3 3
#define COM0A0 6
#define COM0A1 7
#define COM0B0 4
#define COM0B1 5
#define COM1A0 6
#define COM1A1 7
#define COM1B0 4
#define COM1B1 5
#define COM1C0 2
#define COM1C1 3
#define COM2A0 6
#define COM2A1 7
#define COM2B0 4
#define COM2B1 5
#define COM3A0 6
#define COM3A1 7
#define COM3B0 4
#define COM3B1 5
#define COM3C0 2
#define COM3C1 3
#define COM4A0 6
#define COM4A1 7
#define COM4B0 4
#define COM4B1 5
#define COM4C0 2
#define COM4C1 3
#define COM5A0 6
#define COM5A1 7
#define COM5B0 4
#define COM5B1 5
#define COM5C0 2
#define COM5C1 3
#define CPHA 2
#define CPOL 3
#define CS00 0
#define CS01 1
#define CS02 2
#define CS10 0
#define CS11 1
#define CS12 2
#define CS20 0
#define CS21 1
#define CS22 2
#define CS30 0
#define CS31 1
#define CS32 2
#define CS40 0
#define CS41 1
#define CS42 2
#define CS50 0
#define CS51 1
#define CS52 2
#define DD0 0
#define DD1 1
#define DD2 2
#define DD3 3
#define DD4 4
#define DD5 5
#define DD6 6
#define DD7 7
#define DDA0 0
#define DDA1 1
#define DDA2 2
#define DDA3 3
#define DDA4 4
#define DDA5 5
#define DDA6 6
#define DDA7 7
#define DDB0 0
#define DDB1 1
#define DDB2 2
#define DDB3 3
#define DDB4 4
#define DDB5 5
#define DDB6 6
#define DDB7 7
#define DDC0 0
#define DDC1 1
#define DDC2 2
#define DDC3 3
#define DDC4 4
#define DDC5 5
#define DDC6 6
#define DDC7 7
#define DDD0 0
#define DDD1 1
#define DDD2 2
#define DDD3 3
#define DDD4 4
#define DDD5 5
#define DDD6 6
#define DDD7 7
#define DDE0 0
#define DDE1 1
#define DDE2 2
#define DDE3 3
#define DDE4 4
#define DDE5 5
#define DDE6 6
#define DDE7 7
#define DDF0 0
#define DDF1 1
#define DDF2 2
#define DDF3 3
#define DDF4 4
#define DDF5 5
#define DDF6 6
#define DDF7 7
#define DDG0 0
#define DDG1 1
#define DDG2 2
#define DDG3 3
#define DDG4 4
#define DDG5 5
#define DDH0 0
#define DDH1 1
#define DDH2 2
#define DDH3 3
#define DDH4 4
#define DDH5 5
#define DDH6 6
#define DDH7 7
#define DDJ0 0
#define DDJ1 1
#define DDJ2 2
#define DDJ3 3
#define DDJ4 4
#define DDJ5 5
#define DDJ6 6
#define DDJ7 7
#define DDK0 0
#define DDK1 1
#define DDK2 2
#define DDK3 3
#define DDK4 4
#define DDK5 5
#define DDK6 6
#define DDK7 7
#define DDL0 0
#define DDL1 1
#define DDL2 2
#define DDL3 3
#define DDL4 4
#define DDL5 5
#define DDL6 6
#define DDL7 7
#define DOR0 3
#define DOR1 3
#define DOR2 3
#define DOR3 3
#define DORD 5
#define EEMPE 2
#define EEPE 1
#define EEPM0 4
#define EEPM1 5
#define EERE 0
#define EERIE 3
#define EIND0 0
#define EXCLK 6
#define EXTRF 1
#define FE0 4
#define FE1 4
#define FE2 4
#define FE3 4
#define FOC0A 7
#define FOC0B 6
#define FOC1A 7
#define FOC1B 6
#define FOC1C 5
#define FOC2A 7
#define FOC2B 6
#define FOC3A 7
#define FOC3B 6
#define FOC3C 5
#define FOC4A 7
#define FOC4B 6
#define FOC4C 5
#define FOC5A 7
#define FOC5B 6
#define FOC5C 5
#define ICES1 6
#define ICES3 6
#define ICES4 6
#define ICES5 6
#define ICF1 5
#define ICF3 5
#define ICF4 5
#define ICF5 5
#define ICIE1 5
#define ICIE3 5
#define ICIE4 5
#define ICIE5 5
#define ICNC1 7
#define ICNC3 7
#define ICNC4 7
#define ICNC5 7
#define IDRD 7
#define INT0 0
#define INT1 1
#define INT2 2
#define INT3 3
#define INT4 4
#define INT5 5
#define INT6 6
#define INT7 7
#define INTF0 0
#define INTF1 1
#define INTF2 2
#define INTF3 3
#define INTF4 4
#define INTF5 5
#define INTF6 6
#define INTF7 7
#define ISC00 0
#define ISC01 1
#define ISC10 2
#define ISC11 3
#define ISC20 4
#define ISC21 5
#define ISC30 6
#define ISC31 7
#define ISC40 0
#define ISC41 1
#define ISC50 2
#define ISC51 3
#define ISC60 4
#define ISC61 5
#define ISC70 6
#define ISC71 7
#define IVCE 0
#define IVSEL 1
#define JTD 7
#define JTRF 4
#define MPCM0 0
#define MPCM1 0
#define MPCM2 0
#define MPCM3 0
#define MSTR 4
#define MUX0 0
#define MUX1 1
#define MUX2 2
#define MUX3 3
#define MUX4 4
#define MUX5 3
#define OCDR0 0
#define OCDR1 1
#define OCDR2 2
#define OCDR3 3
#define OCDR4 4
#define OCDR5 5
#define OCDR6 6
#define OCDR7 7
#define OCF0A 1
#define OCF0B 2
#define OCF1A 1
#define OCF1B 2
#define OCF1C 3
#define OCF2A 1
#define OCF2B 2
#define OCF3A 1
#define OCF3B 2
#define OCF3C 3
#define OCF4A 1
#define OCF4B 2
#define OCF4C 3
#define OCF5A 1
#define OCF5B 2
#define OCF5C 3
#define OCIE0A 1
#define OCIE0B 2
#define OCIE1A 1
#define OCIE1B 2
#define OCIE1C 3
#define OCIE2A 1
#define OCIE2B 2
#define OCIE3A 1
#define OCIE3B 2
#define OCIE3C 3
#define OCIE4A 1
#define OCIE4B 2
#define OCIE4C 3
#define OCIE5A 1
#define OCIE5B 2
#define OCIE5C 3
#define OCR2AUB 3
#define OCR2BUB 2
#define PA0 0
#define PA1 1
#define PA2 2
#define PA3 3
#define PA4 4
#define PA5 5
#define PA6 6
#define PA7 7
#define PB0 0
#define PB1 1
#define PB2 2
#define PB3 3
#define PB4 4
#define PB5 5
#define PB6 6
#define PB7 7
#define PC0 0
#define PC1 1
#define PC2 2
#define PC3 3
#define PC4 4
#define PC5 5
#define PC6 6
#define PC7 7
#define PCIE0 0
#define PCIE1 1
#define PCIE2 2
#define PCIF0 0
#define PCIF1 1
#define PCIF2 2
#define PCINT0 0
#define PCINT1 1
#define PCINT10 2
#define PCINT11 3
#define PCINT12 4
#define PCINT13 5
#define PCINT14 6
#define PCINT15 7
#define PCINT16 0
#define PCINT17 1
#define PCINT18 2
#define PCINT19 3
#define PCINT2 2
#define PCINT20 4
#define PCINT21 5
#define PCINT22 6
#define PCINT23 7
#define PCINT3 3
#define PCINT4 4
#define PCINT5 5
#define PCINT6 6
#define PCINT7 7
#define PCINT8 0
#define PCINT9 1
#define PD0 0
#define PD1 1
#define PD2 2
#define PD3 3
#define PD4 4
#define PD5 5
#define PD6 6
#define PD7 7
#define PE0 0
#define PE1 1
#define PE2 2
#define PE3 3
#define PE4 4
#define PE5 5
#define PE6 6
#define PE7 7
#define PF0 0
#define PF1 1
#define PF2 2
#define PF3 3
#define PF4 4
#define PF5 5
#define PF6 6
#define PF7 7
#define PG0 0
#define PG1 1
#define PG2 2
#define PG3 3
#define PG4 4
#define PG5 5
#define PGERS 1
#define PGWRT 2
#define PH0 0
#define PH1 1
#define PH2 2
#define PH3 3
#define PH4 4
#define PH5 5
#define PH6 6
#define PH7 7
#define PIN0 0
#define PIN1 1
#define PIN2 2
#define PIN3 3
#define PIN4 4
#define PIN5 5
#define PIN6 6
#define PIN7 7
#define PINA0 0
#define PINA1 1
#define PINA2 2
#define PINA3 3
#define PINA4 4
#define PINA5 5
#define PINA6 6
#define PINA7 7
#define PINB0 0
#define PINB1 1
#define PINB2 2
#define PINB3 3
#define PINB4 4
#define PINB5 5
#define PINB6 6
#define PINB7 7
#define PINC0 0
#define PINC1 1
#define PINC2 2
#define PINC3 3
#define PINC4 4
#define PINC5 5
#define PINC6 6
#define PINC7 7
#define PIND0 0
#define PIND1 1
#define PIND2 2
#define PIND3 3
#define PIND4 4
#define PIND5 5
#define PIND6 6
#define PIND7 7
#define PINE0 0
#define PINE1 1
#define PINE2 2
#define PINE3 3
#define PINE4 4
#define PINE5 5
#define PINE6 6
#define PINE7 7
#define PINF0 0
#define PINF1 1
#define PINF2 2
#define PINF3 3
#define PINF4 4
#define PINF5 5
#define PINF6 6
#define PINF7 7
#define PING0 0
#define PING1 1
#define PING2 2
#define PING3 3
#define PING4 4
#define PING5 5
#define PINH0 0
#define PINH1 1
#define PINH2 2
#define PINH3 3
#define PINH4 4
#define PINH5 5
#define PINH6 6
#define PINH7 7
#define PINJ0 0
#define PINJ1 1
#define PINJ2 2
#define PINJ3 3
#define PINJ4 4
#define PINJ5 5
#define PINJ6 6
#define PINJ7 7
#define PINK0 0
#define PINK1 1
#define PINK2 2
#define PINK3 3
#define PINK4 4
#define PINK5 5
#define PINK6 6
#define PINK7 7
#define PINL0 0
#define PINL1 1
#define PINL2 2
#define PINL3 3
#define PINL4 4
#define PINL5 5
#define PINL6 6
#define PINL7 7
#define PJ0 0
#define PJ1 1
#define PJ2 2
#define PJ3 3
#define PJ4 4
#define PJ5 5
#define PJ6 6
#define PJ7 7
#define PK0 0
#define PK1 1
#define PK2 2
#define PK3 3
#define PK4 4
#define PK5 5
#define PK6 6
#define PK7 7
#define PL0 0
#define PL1 1
#define PL2 2
#define PL3 3
#define PL4 4
#define PL5 5
#define PL6 6
#define PL7 7
#define PORF 0
#define PORT0 0
#define PORT1 1
#define PORT2 2
#define PORT3 3
#define PORT4 4
#define PORT5 5
#define PORT6 6
#define PORT7 7
#define PORTA0 0
#define PORTA1 1
#define PORTA2 2
#define PORTA3 3
#define PORTA4 4
#define PORTA5 5
#define PORTA6 6
#define PORTA7 7
#define PORTB0 0
#define PORTB1 1
#define PORTB2 2
#define PORTB3 3
#define PORTB4 4
#define PORTB5 5
#define PORTB6 6
#define PORTB7 7
#define PORTC0 0
#define PORTC1 1
#define PORTC2 2
#define PORTC3 3
#define PORTC4 4
#define PORTC5 5
#define PORTC6 6
#define PORTC7 7
#define PORTD0 0
#define PORTD1 1
#define PORTD2 2
#define PORTD3 3
#define PORTD4 4
#define PORTD5 5
#define PORTD6 6
#define PORTD7 7
#define PORTE0 0
#define PORTE1 1
#define PORTE2 2
#define PORTE3 3
#define PORTE4 4
#define PORTE5 5
#define PORTE6 6
#define PORTE7 7
#define PORTF0 0
#define PORTF1 1
#define PORTF2 2
#define PORTF3 3
#define PORTF4 4
#define PORTF5 5
#define PORTF6 6
#define PORTF7 7
#define PORTG0 0
#define PORTG1 1
#define PORTG2 2
#define PORTG3 3
#define PORTG4 4
#define PORTG5 5
#define PORTH0 0
#define PORTH1 1
#define PORTH2 2
#define PORTH3 3
#define PORTH4 4
#define PORTH5 5
#define PORTH6 6
#define PORTH7 7
#define PORTJ0 0
#define PORTJ1 1
#define PORTJ2 2
#define PORTJ3 3
#define PORTJ4 4
#define PORTJ5 5
#define PORTJ6 6
#define PORTJ7 7
#define PORTK0 0
#define PORTK1 1
#define PORTK2 2
#define PORTK3 3
#define PORTK4 4
#define PORTK5 5
#define PORTK6 6
#define PORTK7 7
#define PORTL0 0
#define PORTL1 1
#define PORTL2 2
#define PORTL3 3
#define PORTL4 4
#define PORTL5 5
#define PORTL6 6
#define PORTL7 7
#define PRADC 0
#define PRSPI 2
#define PRTIM0 5
#define PRTIM1 3
#define PRTIM2 6
#define PRTIM3 3
#define PRTIM4 4
#define PRTIM5 5
#define PRTWI 7
#define PRUSART0 1
#define PRUSART1 0
#define PRUSART2 1
#define PRUSART3 2
#define PSRASY 1
#define PSRSYNC 0
#define PUD 4
#define REFS0 6
#define REFS1 7
#define RWWSB 6
#define RWWSRE 4
#define RXB80 1
#define RXB81 1
#define RXB82 1
#define RXB83 1
#define RXC0 7
#define RXC1 7
#define RXC2 7
#define RXC3 7
#define RXCIE0 7
#define RXCIE1 7
#define RXCIE2 7
#define RXCIE3 7
#define RXEN0 4
#define RXEN1 4
#define RXEN2 4
#define RXEN3 4
#define SE 0
#define SIGRD 5
#define SM0 1
#define SM1 2
#define SM2 3
#define SPE 6
#define SPI2X 0
#define SPIE 7
#define SPIF 7
#define SPR0 0
#define SPR1 1
#define SRE 7
#define SRL0 4
#define SRL1 5
#define SRL2 6
#define SRW00 0
#define SRW01 1
#define SRW10 2
#define SRW11 3
#define TCN2UB 4
#define TCR2AUB 1
#define TCR2BUB 0
#define TOIE0 0
#define TOIE1 0
#define TOIE2 0
#define TOIE3 0
#define TOIE4 0
#define TOIE5 0
#define TOV0 0
#define TOV1 0
#define TOV2 0
#define TOV3 0
#define TOV4 0
#define TOV5 0
#define TSM 7
#define TWA0 1
#define TWA1 2
#define TWA2 3
#define TWA3 4
#define TWA4 5
#define TWA5 6
#define TWA6 7
#define TWAM0 1
#define TWAM1 2
#define TWAM2 3
#define TWAM3 4
#define TWAM4 5
#define TWAM5 6
#define TWAM6 7
#define TWEA 6
#define TWEN 2
#define TWGCE 0
#define TWIE 0
#define TWINT 7
#define TWPS0 0
#define TWPS1 1
#define TWS3 3
#define TWS4 4
#define TWS5 5
#define TWS6 6
#define TWS7 7
#define TWSTA 5
#define TWSTO 4
#define TWWC 3
#define TXB80 0
#define TXB81 0
#define TXB82 0
#define TXB83 0
#define TXC0 6
#define TXC1 6
#define TXC2 6
#define TXC3 6
#define TXCIE0 6
#define TXCIE1 6
#define TXCIE2 6
#define TXCIE3 6
#define TXEN0 3
#define TXEN1 3
#define TXEN2 3
#define TXEN3 3
#define U2X0 1
#define U2X1 1
#define U2X2 1
#define U2X3 1
#define UCPOL0 0
#define UCPOL1 0
#define UCPOL2 0
#define UCPOL3 0
#define UCSZ00 1
#define UCSZ01 2
#define UCSZ02 2
#define UCSZ10 1
#define UCSZ11 2
#define UCSZ12 2
#define UCSZ20 1
#define UCSZ21 2
#define UCSZ22 2
#define UCSZ30 1
#define UCSZ31 2
#define UCSZ32 2
#define UDRE0 5
#define UDRE1 5
#define UDRE2 5
#define UDRE3 5
#define UDRIE0 5
#define UDRIE1 5
#define UDRIE2 5
#define UDRIE3 5
#define UMSEL00 6
#define UMSEL01 7
#define UMSEL10 6
#define UMSEL11 7
#define UMSEL20 6
#define UMSEL21 7
#define UMSEL30 6
#define UMSEL31 7
#define UPE0 2
#define UPE1 2
#define UPE2 2
#define UPE3 2
#define UPM00 4
#define UPM01 5
#define UPM10 4
#define UPM11 5
#define UPM20 4
#define UPM21 5
#define UPM30 4
#define UPM31 5
#define USBS0 3
#define USBS1 3
#define USBS2 3
#define USBS3 3
#define WCOL 6
#define WDCE 4
#define WDE 3
#define WDIE 6
#define WDIF 7
#define WDP0 0
#define WDP1 1
#define WDP2 2
#define WDP3 5
#define WDRF 3
#define WGM00 0
#define WGM01 1
#define WGM02 3
#define WGM10 0
#define WGM11 1
#define WGM12 3
#define WGM13 4
#define WGM20 0
#define WGM21 1
#define WGM22 3
#define WGM30 0
#define WGM31 1
#define WGM32 3
#define WGM33 4
#define WGM40 0
#define WGM41 1
#define WGM42 3
#define WGM43 4
#define WGM50 0
#define WGM51 1
#define WGM52 3
#define WGM53 4
#define XMBK 7
#define XMM0 0
#define XMM1 1
#define XMM2 2
