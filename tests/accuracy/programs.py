"""Programs of the project, as accuracy is measured with them."""
import subprocess
import sys


def output_of(*command):
    """What a program prints; ends with what it complains of where it fails."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        sys.exit(f"There is no {command[0]}; build the project, and give its folder with --build.")
    except subprocess.CalledProcessError as error:
        sys.exit(error.stderr.strip())
