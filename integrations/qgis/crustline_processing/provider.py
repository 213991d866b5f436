"""The provider: its algorithms, its icon, and the setting that says where the command is."""

from pathlib import Path

from processing.core.ProcessingConfig import ProcessingConfig, Setting
from qgis.core import QgsProcessingProvider
from qgis.PyQt.QtGui import QIcon

from .certify import Certify
from .command import SETTING
from .medial_axis import MedialAxis
from .reconstruct import Reconstruct
from .thin import Thin

ICONS = Path(__file__).parent / "icons"


class CrustlineProvider(QgsProcessingProvider):
    """crustline's algorithms."""

    def id(self):
        return "crustline"

    def name(self):
        return "crustline"

    def icon(self):
        return QIcon(str(ICONS / "reconstruct.svg"))

    def load(self):
        """Add the setting, then the algorithms."""
        ProcessingConfig.settingIcons[self.name()] = self.icon()
        ProcessingConfig.addSetting(
            Setting(self.name(), SETTING, "The command crustline, if it is not on the path", "")
        )
        ProcessingConfig.readSettings()
        self.refreshAlgorithms()
        return True

    def unload(self):
        """Take the setting away."""
        ProcessingConfig.removeSetting(SETTING)

    def loadAlgorithms(self):
        for make in (Reconstruct, MedialAxis, Certify, Thin):
            self.addAlgorithm(make())
