package umbilic;

import java.util.OptionalLong;

/** What the library refused. */
public class UmbilicException extends RuntimeException {
  private static final long serialVersionUID = 1;

  private final int status;
  private final Long element; // or null: an OptionalLong cannot be serialised

  UmbilicException(int status, String message, Long element) {
    super(message + " (status " + status + (element == null ? "" : ", element " + element) + ")");
    this.status = status;
    this.element = element;
  }

  /** A UMB_ERROR_ constant. */
  public int status() {
    return status;
  }

  /** The offending corner, face, vertex or value. */
  public OptionalLong element() {
    return element == null ? OptionalLong.empty() : OptionalLong.of(element);
  }
}
