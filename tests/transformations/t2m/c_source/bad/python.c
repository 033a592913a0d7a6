def main():
    print("hello")
    for i in range(10):
        led.high()

if __name__ == "__main__":
    main()
