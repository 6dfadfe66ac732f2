from .case import Case as Case
from .case import Finding as Finding
from .errors import CaseError as CaseError
from .errors import OutputError as OutputError
from .errors import PlastronError as PlastronError
from .errors import PlastronWarning as PlastronWarning
from .errors import PointError as PointError
from .errors import ResultsError as ResultsError
from .functions import Function as Function
from .functions import components as components
from .load_cases import LoadCase as LoadCase
from .load_cases import combine as combine
from .result import Record as Record
from .result import Result as Result
from .solving import Verification as Verification
from .solving import load as load
from .solving import solve as solve
from .solving import verify as verify
from .sweeping import Table as Table
from .sweeping import differences as differences
from .sweeping import sweep as sweep
from . import sections as sections

__version__: str
