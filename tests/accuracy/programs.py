"""Programs of the project, as accuracy is measured with them."""
import subprocess
import sys


def output_of(*command):
    """The output of a program; ends with its error message if it fails."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except FileNotFoundError:
        sys.exit(f"There is no {command[0]}; build the project, and give its folder with --build.")
    except subprocess.CalledProcessError as error:
        sys.exit(error.stderr.strip())
